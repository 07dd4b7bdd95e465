// SPDX-License-Identifier: MIT
//
// The types of a module: each exists once, so that they are compared by address.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

class IrTypes {
 public:
  explicit IrTypes(ir::Module& module) : module_(module) {}

  // Scalars must be plain. Rows 0: a vector; columns 0 or 1 then: a scalar.
  const ir::Type* numeric(Scalar scalar, uint32_t rows, uint32_t columns);
  const ir::Type* scalar(Scalar scalar) { return numeric(scalar, 0, 0); }
  const ir::Type* vector(Scalar scalar, uint32_t size) { return numeric(scalar, 0, size); }
  // The type of the same shape with another scalar.
  const ir::Type* with_scalar(const ir::Type* shape, Scalar scalar);
  const ir::Type* array(const ir::Type* element, uint32_t count);
  // The element of a typed buffer or texture is what its texels hold.
  const ir::Type* resource(ir::ResourceKind kind, const ir::Type* element);
  const ir::Type* ray_query(uint32_t flags);
  // New ones at every call.
  const ir::Type* void_type() { return make(ir::TypeKind::kVoid); }
  const ir::Type* structure(const ir::Struct* structure);

 private:
  ir::Type* make(ir::TypeKind kind);

  ir::Module& module_;
  std::unordered_map<uint32_t, const ir::Type*> numeric_;
  std::map<std::pair<const ir::Type*, uint32_t>, const ir::Type*> arrays_;
  std::map<std::pair<ir::ResourceKind, const ir::Type*>, const ir::Type*> resources_;
  std::map<uint32_t, const ir::Type*> ray_queries_;
};

}  // namespace kaamos::hlsl
