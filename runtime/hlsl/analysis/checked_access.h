// SPDX-License-Identifier: MIT
//
// Instrumented code (-check-access): what every emitter and the interpreter ask of the IR for it.
#pragma once

#include <cstdint>

#include <kaamos/shader/abi.h>
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// shader::CheckReport::site
inline uint32_t site_of(const ir::Location& location) {
  return shader::make_site(location.file, location.line);
}

// Of a load or store: its bytes, and the alignment that its scalars ask for, up to 4.
struct Access {
  uint32_t bytes = 0;
  uint32_t alignment = 4;
};
Access access_of(const ir::Type* type, ir::Layout layout, bool row_major);

// Equal for types of the same scalars in the same order, whatever their names.
// [DXR: payload and callable types must match]
// Of two reported types: 0 is none, 1 several.
constexpr uint32_t joined_type(uint32_t a, uint32_t b) {
  return a == 0 || a == b ? b : b == 0 ? a : 1;
}
uint32_t type_hash(const ir::Type* type);

// What the descriptor of a resource must be.
struct ResourceClass {
  shader::DescriptorKind kind = shader::DescriptorKind::kNull;
  shader::DescriptorAccess access = shader::DescriptorAccess::kOther;
};
ResourceClass class_of(ir::ResourceKind kind);

// What must be there when a value of a RayQuery is read: nothing, or a hit, of `type` if that is
// not 0xFFFFFFFF. [DXR: RayQuery intrinsics]
struct QueryNeed {
  bool hit = false;
  uint32_t type = 0xFFFFFFFFu;
};
QueryNeed need_of(const ir::Expr& query_value);

}  // namespace kaamos::hlsl
