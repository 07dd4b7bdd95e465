// SPDX-License-Identifier: MIT
//
// Places the members of a constant buffer: first those whose offset is written, by packoffset or a
// register, then the others behind the last of them, in their order. What takes no memory (structs
// of resources alone, empty ones) begins no row, and where min16 types follow others, or others
// follow them, a new row begins. [DXC: AllocateDxilConstantBuffer]
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/names/symbols.h"

namespace kaamos::hlsl {

struct BufferMember {
  // A variable, or what of a struct with resources is memory.
  struct Part {
    VariableInfo* variable;
    size_t field;         // of the buffer's ir::Struct
    uint32_t offset = 0;  // in the member
  };
  std::string_view name;
  SourceLocation location;
  const Type* type = nullptr;
  uint32_t size = 0;
  int64_t written = -1;  // its offset
  std::vector<Part> parts;
};

struct PlacedMembers {
  uint32_t size = 0;                      // of the buffer
  const BufferMember* too_far = nullptr;  // the first that ends behind kMaxBufferBytes
};

// Sets the offsets of the variables and of the buffer's fields.
PlacedMembers place_members(const std::vector<BufferMember>& members, ir::Struct& structure);

}  // namespace kaamos::hlsl
