// SPDX-License-Identifier: MIT
//
// The spellings of binary operators: in the languages that have them, and as functions of the
// preludes of emitted code, for the types where the language's operator means something else.
#pragma once

#include <cstddef>
#include <iterator>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl::ir {

struct BinarySpelling {
  const char* symbol;  // of HLSL, C++ and GLSL
  // True if it means the same in all three on scalars of 32 and 64 bits. Division by zero, and
  // counts of shifts that are too large, do not.
  bool is_native;
  const char* cpp;  // in namespace ks
  const char* glsl;
};

// In the order of BinaryOp.
inline constexpr BinarySpelling kBinarySpellings[] = {
    {"+", true, "ks::add", "k_add"},          {"-", true, "ks::sub", "k_subtract"},
    {"*", true, "ks::mul_c", "k_multiply"},   {"/", false, "ks::div", "k_divide"},
    {"%", false, "ks::mod", "k_modulo"},      {"&", true, "ks::bit_and", "k_bit_and"},
    {"|", true, "ks::bit_or", "k_bit_or"},    {"^", true, "ks::bit_xor", "k_bit_xor"},
    {"<<", false, "ks::shl", "k_shift_left"}, {">>", false, "ks::shr", "k_shift_right"},
    {"<", true, "ks::less", "k_less"},        {"<=", true, "ks::less_equal", "k_less_equal"},
    {">", true, "ks::greater", "k_greater"},  {">=", true, "ks::greater_equal", "k_greater_equal"},
    {"==", true, "ks::equal", "k_equal"},     {"!=", true, "ks::not_equal", "k_not_equal"},
};
static_assert(std::size(kBinarySpellings) == static_cast<size_t>(BinaryOp::kNotEqual) + 1);

constexpr const BinarySpelling& spelling_of(BinaryOp op) {
  return kBinarySpellings[static_cast<size_t>(op)];
}

}  // namespace kaamos::hlsl::ir
