// SPDX-License-Identifier: MIT
#include "layout.h"

#include <algorithm>

namespace kaamos::hlsl {
namespace {

uint32_t align(uint64_t offset, uint32_t alignment) {
  const uint64_t aligned = (offset + alignment - 1) / alignment * alignment;
  return static_cast<uint32_t>(std::min<uint64_t>(aligned, kMaxLayoutBytes));
}

uint32_t clamp_size(uint64_t size) {
  return static_cast<uint32_t>(std::min<uint64_t>(size, kMaxLayoutBytes));
}

// The vectors that a matrix consists of in memory.
uint32_t vector_count(const Type* matrix) {
  return matrix->row_major ? matrix->rows : matrix->columns;
}
uint32_t vector_size(const Type* matrix) {
  return matrix->row_major ? matrix->columns : matrix->rows;
}

bool starts_row(const Type* type) {
  if (type->is_array() || type->is_struct()) return true;
  return type->is_matrix() && vector_count(type) > 1;
}

LayoutSize struct_layout(const StructInfo& structure, ir::Layout layout) {
  LayoutSize result;
  result.alignment = layout == ir::Layout::kConstantBuffer ? 16 : 1;
  uint32_t offset = 0;
  const auto add = [&](const Type* type) {
    const LayoutSize member = layout_of(type, layout);
    offset = clamp_size(uint64_t{place_member(type, offset, layout)} + member.size);
    result.alignment = std::max(result.alignment, member.alignment);
  };
  if (structure.base) add(structure.base->type);
  for (const FieldInfo& field : structure.fields) add(field.type);
  result.size = layout == ir::Layout::kStructured ? align(offset, result.alignment) : offset;
  return result;
}

}  // namespace

LayoutSize layout_of(const Type* type, ir::Layout layout) {
  const bool constant_buffer = layout == ir::Layout::kConstantBuffer;
  switch (type->kind) {
    case TypeKind::kNumeric: {
      const uint32_t bytes = scalar_bytes(type->scalar);
      if (!type->is_matrix()) return {type->components() * bytes, bytes};
      const uint32_t stride = matrix_stride(type, layout);
      return {(vector_count(type) - 1) * stride + vector_size(type) * bytes,
              constant_buffer ? 16 : bytes};
    }
    case TypeKind::kEnum: {
      const uint32_t bytes = scalar_bytes(type->scalar);
      return {bytes, bytes};
    }
    case TypeKind::kArray: {
      const LayoutSize element = layout_of(type->element, layout);
      if (type->count == 0) return {0, element.alignment};
      const uint64_t stride = array_stride(type->element, layout);
      return {clamp_size((type->count - 1) * stride + element.size),
              constant_buffer ? 16 : element.alignment};
    }
    case TypeKind::kStruct:
      return struct_layout(*type->structure, layout);
    default:
      return {0, 1};
  }
}

uint32_t array_stride(const Type* element, ir::Layout layout) {
  const LayoutSize size = layout_of(element, layout);
  return align(size.size, layout == ir::Layout::kConstantBuffer ? 16 : size.alignment);
}

uint32_t matrix_stride(const Type* matrix, ir::Layout layout) {
  const uint32_t bytes = vector_size(matrix) * scalar_bytes(matrix->scalar);
  return layout == ir::Layout::kConstantBuffer ? align(bytes, 16) : bytes;
}

uint32_t place_member(const Type* type, uint32_t offset, ir::Layout layout) {
  const LayoutSize size = layout_of(type, layout);
  if (layout == ir::Layout::kStructured) return align(offset, size.alignment);
  if (starts_row(type)) return align(offset, 16);
  const uint32_t scalar = scalar_bytes(type->scalar);
  offset = align(offset, scalar);
  return offset % 16 + size.size > 16 ? align(offset, 16) : offset;
}

uint32_t field_offset(const StructInfo& structure, uint32_t index, ir::Layout layout) {
  uint32_t offset = 0;
  uint32_t position = 0;
  const auto step = [&](const Type* type) {
    offset = place_member(type, offset, layout);
    if (position++ == index) return true;
    offset = clamp_size(uint64_t{offset} + layout_of(type, layout).size);
    return false;
  };
  if (structure.base && step(structure.base->type)) return offset;
  for (const FieldInfo& field : structure.fields) {
    if (step(field.type)) return offset;
  }
  return offset;
}

uint32_t payload_bytes(const Type* type) {
  switch (type->kind) {
    case TypeKind::kNumeric:
    case TypeKind::kEnum:
      return type->components() * std::max(4u, scalar_bytes(type->scalar));
    case TypeKind::kArray:
      return clamp_size(uint64_t{payload_bytes(type->element)} * type->count);
    case TypeKind::kStruct: {
      uint64_t bytes = type->structure->base ? payload_bytes(type->structure->base->type) : 0;
      for (const FieldInfo& field : type->structure->fields) bytes += payload_bytes(field.type);
      return clamp_size(bytes);
    }
    default:
      return 0;
  }
}

}  // namespace kaamos::hlsl
