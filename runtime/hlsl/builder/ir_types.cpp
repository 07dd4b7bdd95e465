// SPDX-License-Identifier: MIT
#include "runtime/hlsl/builder/ir_types.h"

#include <algorithm>
#include <cassert>

#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

ir::Type* IrTypes::make(ir::TypeKind kind) {
  ir::Type* type = &module_.type_pool.emplace_back();
  type->kind = kind;
  return type;
}

const ir::Type* IrTypes::numeric(Scalar scalar, uint32_t rows, uint32_t columns) {
  assert(is_plain(scalar));
  if (rows == 0 && columns == 1) columns = 0;
  const ir::Type*& slot = numeric_[static_cast<uint32_t>(scalar) << 24 | rows << 16 | columns];
  if (slot) return slot;
  ir::Type* type = make(rows      ? ir::TypeKind::kMatrix
                        : columns ? ir::TypeKind::kVector
                                  : ir::TypeKind::kScalar);
  type->scalar = scalar;
  type->rows = static_cast<uint8_t>(std::max(rows, 1u));
  type->columns = static_cast<uint16_t>(std::max(columns, 1u));
  return slot = type;
}

const ir::Type* IrTypes::with_scalar(const ir::Type* shape, Scalar scalar) {
  const uint32_t rows = shape->kind == ir::TypeKind::kMatrix ? shape->rows : 0;
  const uint32_t columns = shape->kind == ir::TypeKind::kScalar ? 0 : shape->columns;
  return numeric(scalar, rows, columns);
}

const ir::Type* IrTypes::array(const ir::Type* element, uint32_t count) {
  const ir::Type*& slot = arrays_[{element, count}];
  if (slot) return slot;
  ir::Type* type = make(ir::TypeKind::kArray);
  type->element = element;
  type->count = count;
  return slot = type;
}

const ir::Type* IrTypes::resource(ir::ResourceKind kind, const ir::Type* element) {
  // Append and consume buffers are those with a counter.
  if (has_elements(kind) && !is_structured(kind)) kind = ir::ResourceKind::kRWStructuredBuffer;
  const ir::Type*& slot = resources_[{kind, element}];
  if (slot) return slot;
  ir::Type* type = make(ir::TypeKind::kResource);
  type->resource = kind;
  type->element = element;
  return slot = type;
}

const ir::Type* IrTypes::ray_query(uint32_t flags) {
  const ir::Type*& slot = ray_queries_[flags];
  if (slot) return slot;
  ir::Type* type = make(ir::TypeKind::kResource);
  type->resource = ir::ResourceKind::kRayQuery;
  type->ray_query_flags = flags;
  return slot = type;
}

const ir::Type* IrTypes::structure(const ir::Struct* structure) {
  ir::Type* type = make(ir::TypeKind::kStruct);
  type->structure = structure;
  return type;
}

}  // namespace kaamos::hlsl
