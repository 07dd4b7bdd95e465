// SPDX-License-Identifier: MIT
//
// Constant evaluation on the intermediate representation, with HLSL's arithmetic: wrapping
// integers, masked shifts, saturating float-to-integer conversion. [hlsl-subset 3.8]
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Scalars are held as ir::Expr::literal holds them.
uint64_t convert_bits(uint64_t bits, ir::Scalar from, ir::Scalar to);
uint64_t float_bits(double value);
double float_value(uint64_t bits);
// Brings an exact value into the range and precision of a type.
uint64_t normalise_bits(uint64_t bits, ir::Scalar scalar);

// Empty where the result is not to be fixed at compile time: integer division by zero.
std::optional<uint64_t> fold_binary(ir::BinaryOp op, ir::Scalar scalar, uint64_t left,
                                    uint64_t right);
std::optional<uint64_t> fold_unary(ir::UnaryOp op, ir::Scalar scalar, uint64_t operand);

// The components (in row-major order) of a numeric expression, if all are known.
std::optional<std::vector<uint64_t>> evaluate(const ir::Expr* expression);
// An expression that is known when the library is compiled; arrays and structs too.
bool is_constant(const ir::Expr* expression);

}  // namespace kaamos::hlsl
