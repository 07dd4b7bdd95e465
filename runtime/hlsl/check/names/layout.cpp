// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/layout.h"

#include <algorithm>

#include "runtime/hlsl/ir/layout.h"

namespace kaamos::hlsl {
namespace {

uint32_t clamp_size(uint64_t size) {
  return static_cast<uint32_t>(std::min<uint64_t>(size, kMaxLayoutBytes));
}

// For a matrix, or for the matrices in an array: the IR's type does not record the storage order.
bool is_row_major(const Type* type) {
  while (type->is_array()) type = type->element;
  return type->is_numeric() && type->row_major;
}

}  // namespace

LayoutSize layout_of(const Type* type, ir::Layout layout) {
  if (type->ir == nullptr) return {0, 1};
  const ir::Extent extent = ir::extent_of(type->ir, layout, is_row_major(type));
  return {clamp_size(extent.size), extent.alignment};
}

uint32_t array_stride(const Type* element, ir::Layout layout) {
  return clamp_size(ir::array_stride(element->ir, layout, is_row_major(element)));
}

uint32_t matrix_stride(const Type* matrix, ir::Layout layout) {
  return ir::matrix_stride(matrix->ir, layout, matrix->row_major);
}

uint32_t place_member(const Type* type, uint32_t offset, ir::Layout layout) {
  return clamp_size(ir::place_member(type->ir, offset, layout, is_row_major(type)));
}

uint32_t field_offset(const StructInfo& structure, uint32_t index, ir::Layout layout) {
  return ir::field_offsets(*structure.ir, layout)[index];
}

uint32_t payload_bytes(const Type* type) {
  switch (type->kind) {
    case TypeKind::kNumeric:
    case TypeKind::kEnum:
      return type->components() * std::max(4u, scalar_bytes(type->scalar, ScalarStorage::kBuffer));
    case TypeKind::kArray:
      return clamp_size(uint64_t{payload_bytes(type->element)} * type->count);
    case TypeKind::kStruct: {
      uint64_t bytes = type->structure->base ? payload_bytes(type->structure->base->type) : 0;
      for (const FieldInfo& field : type->structure->fields) {
        if (field.begins_field()) bytes += payload_bytes(field.unit ? field.unit : field.type);
      }
      return clamp_size(bytes);
    }
    default:
      return 0;
  }
}

}  // namespace kaamos::hlsl
