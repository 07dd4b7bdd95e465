// SPDX-License-Identifier: MIT
#include "runtime/hlsl/ir/layout.h"

#include <algorithm>

namespace kaamos::hlsl::ir {
namespace {

uint64_t align(uint64_t offset, uint64_t alignment) {
  return (offset + alignment - 1) / alignment * alignment;
}

uint32_t scalar_alignment(const Type* type) {
  return type->kind == TypeKind::kScalar || type->kind == TypeKind::kVector ||
                 type->kind == TypeKind::kMatrix
             ? scalar_bytes(type->scalar, ScalarStorage::kBuffer)
             : 1;
}

Extent extent_of_matrix(const Type* type, Layout layout, bool row_major) {
  const uint32_t bytes = scalar_bytes(type->scalar, ScalarStorage::kBuffer);
  const uint32_t lines = row_major ? type->rows : type->columns;
  const uint32_t line = bytes * (row_major ? type->columns : type->rows);
  const uint64_t size = uint64_t{matrix_stride(type, layout, row_major)} * (lines - 1) + line;
  // A matrix with a single line is laid out like a vector.
  return {size, layout == Layout::kConstantBuffer && lines > 1 ? 16 : bytes};
}

Extent extent_of_struct(const Struct& structure, Layout layout) {
  uint64_t end = 0;
  uint32_t alignment = layout == Layout::kConstantBuffer ? 16 : 1;
  const std::vector<uint32_t> offsets = field_offsets(structure, layout);
  for (size_t i = 0; i < offsets.size(); ++i) {
    const Field& field = structure.fields[i];
    const Extent extent = extent_of(field.type, layout, field.row_major);
    end = std::max(end, offsets[i] + extent.size);
    alignment = std::max(alignment, extent.alignment);
  }
  return {layout == Layout::kStructured ? align(end, alignment) : end, alignment};
}

}  // namespace

Extent extent_of(const Type* type, Layout layout, bool row_major) {
  switch (type->kind) {
    case TypeKind::kScalar:
      return {scalar_bytes(type->scalar, ScalarStorage::kBuffer),
              scalar_bytes(type->scalar, ScalarStorage::kBuffer)};
    case TypeKind::kVector:
      return {uint64_t{scalar_bytes(type->scalar, ScalarStorage::kBuffer)} * type->columns,
              scalar_bytes(type->scalar, ScalarStorage::kBuffer)};
    case TypeKind::kMatrix:
      return extent_of_matrix(type, layout, row_major);
    case TypeKind::kArray: {
      const Extent element = extent_of(type->element, layout, row_major);
      const uint64_t stride = array_stride(type->element, layout, row_major);
      return {type->count == 0 ? 0 : stride * (type->count - 1) + element.size,
              layout == Layout::kConstantBuffer ? 16 : element.alignment};
    }
    case TypeKind::kStruct:
      return extent_of_struct(*type->structure, layout);
    default:
      return {0, 1};
  }
}

uint64_t array_stride(const Type* element, Layout layout, bool row_major) {
  const Extent extent = extent_of(element, layout, row_major);
  return align(extent.size, layout == Layout::kConstantBuffer ? 16 : extent.alignment);
}

uint32_t matrix_stride(const Type* matrix, Layout layout, bool row_major) {
  const uint32_t line = scalar_bytes(matrix->scalar, ScalarStorage::kBuffer) *
                        (row_major ? matrix->columns : matrix->rows);
  return static_cast<uint32_t>(layout == Layout::kConstantBuffer ? align(line, 16) : line);
}

uint64_t place_member(const Type* type, uint64_t offset, Layout layout, bool row_major) {
  const Extent extent = extent_of(type, layout, row_major);
  if (layout == Layout::kStructured || extent.alignment == 16) {
    return align(offset, extent.alignment);
  }
  offset = align(offset, scalar_alignment(type));
  return offset % 16 + extent.size > 16 ? align(offset, 16) : offset;
}

std::vector<uint32_t> field_offsets(const Struct& structure, Layout layout) {
  std::vector<uint32_t> offsets;
  uint64_t end = 0;
  for (const Field& field : structure.fields) {
    uint64_t at = place_member(field.type, end, layout, field.row_major);
    if (layout == Layout::kConstantBuffer && field.packoffset >= 0) {
      at = static_cast<uint64_t>(field.packoffset);
    }
    offsets.push_back(static_cast<uint32_t>(at));
    end = at + extent_of(field.type, layout, field.row_major).size;
  }
  return offsets;
}

}  // namespace kaamos::hlsl::ir
