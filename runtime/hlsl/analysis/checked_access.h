// SPDX-License-Identifier: MIT
//
// Instrumented code (-check-access): what the emitters and the interpreter need to know about the
// IR to instrument it.
#pragma once

#include <cstdint>

#include <kaamos/shader/abi.h>
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// shader::CheckReport::site
inline uint32_t site_of(const ir::Location& location) {
  return shader::make_site(location.file, location.line);
}

// The size of a load or store in bytes, and the alignment that its scalars require, up to 4.
struct Access {
  uint32_t bytes = 0;
  uint32_t alignment = 4;
};
Access access_of(const ir::Type* type, ir::Layout layout, bool row_major);

// type_hash is the same for types with the same scalars in the same order, whatever their names.
// [DXR: payload and callable types must match]
// joined_type combines two reported types, where 0 means none and 1 several.
constexpr uint32_t joined_type(uint32_t a, uint32_t b) {
  return a == 0 || a == b ? b : b == 0 ? a : 1;
}
uint32_t type_hash(const ir::Type* type);

// The kind of descriptor that a resource must have.
struct ResourceClass {
  shader::DescriptorKind kind = shader::DescriptorKind::kNull;
  shader::DescriptorAccess access = shader::DescriptorAccess::kOther;
};
ResourceClass class_of(ir::ResourceKind kind);

// The state that reading a value of a RayQuery requires: none, or a hit, of `type` unless that is
// 0xFFFFFFFF. [DXR: RayQuery intrinsics]
struct QueryNeed {
  bool hit = false;
  uint32_t type = 0xFFFFFFFFu;
};
QueryNeed need_of(const ir::Expr& query_value);

}  // namespace kaamos::hlsl
