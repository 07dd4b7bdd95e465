// SPDX-License-Identifier: MIT
//
// Constant evaluation on the intermediate representation, with HLSL's arithmetic: wrapping
// integers, masked shifts, saturating float-to-integer conversion. [D3D11.3: ishl, ftoi, ftou]
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Converts a scalar in the form in which ir::Expr::literal holds it.
uint64_t convert_bits(uint64_t bits, Scalar from, Scalar to);
uint64_t float_bits(double value);
double float_value(uint64_t bits);
// Brings an exact value into the range and precision of a type.
uint64_t normalise_bits(uint64_t bits, Scalar scalar);

// Empty if the result must not be fixed at compile time, as with an integer division by zero.
std::optional<uint64_t> fold_binary(ir::BinaryOp op, Scalar scalar, uint64_t left, uint64_t right);
std::optional<uint64_t> fold_unary(ir::UnaryOp op, Scalar scalar, uint64_t operand);

// The components of a numeric expression in row-major order, if all of them are known.
std::optional<std::vector<uint64_t>> evaluate(const ir::Expr* expression);
// Returns whether the expression, which may be an array or a struct, is known at compile time.
bool is_constant(const ir::Expr* expression);

}  // namespace kaamos::hlsl
