// SPDX-License-Identifier: MIT
//
// The layout in which the interpreter stores values: byte for byte like the C++ types that emit_cpp
// prints (vec, mat and array of vector.h without padding, structs with natural alignment).
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl::interpret {

struct Extent {
  uint32_t bytes = 0;
  uint32_t alignment = 1;
};

// Longer values are rejected, because they would exhaust the threads' stacks.
inline constexpr uint32_t kMaxValueBytes = 1u << 24;
// The limit for one load or store; anything beyond it is moved only in part.
inline constexpr size_t kMaxMoves = 1u << 20;

// Components of a scalar, vector or matrix.
uint32_t component_count(const ir::Type* type);
uint32_t align(uint32_t offset, uint32_t alignment);

// A run of scalars that is contiguous both in a value and in a buffer.
struct Move {
  uint32_t member =
      0;               // byte offset in the buffer of the scalar, vector, matrix or array around it
  uint32_t mask = 0;   // raw offsets of that member are rounded down by it
  uint32_t at = 0;     // bytes from the member's start
  uint32_t value = 0;  // bytes from the value's start
  uint32_t count = 0;  // scalars
  uint8_t bytes = 0;   // of a scalar in the buffer; bool takes 4
  bool is_bool = false;
};

// Caches the structs it has seen: nested in each other, they can expand to millions of members.
class Layouts {
 public:
  // bytes is never more than kMaxValueBytes + 1, which means that the type is too large.
  Extent extent_of(const ir::Type* type);
  uint32_t field_offset(const ir::Struct& structure, uint32_t field);
  // The moves that copy a value of the type to and from a buffer.
  std::vector<Move> moves_of(const ir::Type* type, ir::Layout layout, bool row_major);

 private:
  struct StructLayout {
    Extent extent;
    std::vector<uint32_t> offsets;
  };
  const StructLayout& layout_of(const ir::Struct& structure);

  std::unordered_map<const ir::Struct*, StructLayout> structs_;
};

}  // namespace kaamos::hlsl::interpret
