// SPDX-License-Identifier: MIT
#include "runtime/hlsl/ir/host_layout.h"

#include <algorithm>

#include "kaamos/shader/abi.h"
#include "runtime/hlsl/ir/layout.h"

namespace kaamos::hlsl::interpret {

using namespace ir;

uint32_t align(uint32_t offset, uint32_t alignment) {
  return (offset + alignment - 1) / alignment * alignment;
}

uint32_t component_count(const Type* type) {
  switch (type->kind) {
    case TypeKind::kScalar:
      return 1;
    case TypeKind::kVector:
      return type->columns;
    case TypeKind::kMatrix:
      return uint32_t{type->rows} * type->columns;
    default:
      return 0;
  }
}

const Layouts::StructLayout& Layouts::layout_of(const Struct& structure) {
  const auto known = structs_.find(&structure);
  if (known != structs_.end()) return known->second;
  StructLayout out;
  out.extent = {0, 1};
  for (const Field& field : structure.fields) {
    const Extent member = extent_of(field.type);
    const uint32_t at = align(out.extent.bytes, member.alignment);
    out.offsets.push_back(at);
    out.extent.alignment = std::max(out.extent.alignment, member.alignment);
    out.extent.bytes = std::min(at + member.bytes, kMaxValueBytes + 1);
  }
  // An empty struct takes one byte in C++.
  const uint32_t bytes = std::max(align(out.extent.bytes, out.extent.alignment), 1u);
  out.extent.bytes = std::min(bytes, kMaxValueBytes + 1);
  return structs_.emplace(&structure, std::move(out)).first->second;
}

Extent Layouts::extent_of(const Type* type) {
  switch (type->kind) {
    case TypeKind::kVoid:
      return {0, 1};
    case TypeKind::kScalar:
    case TypeKind::kVector:
    case TypeKind::kMatrix: {
      const uint32_t bytes = scalar_bytes(type->scalar, ScalarStorage::kVariable);
      return {bytes * component_count(type), bytes};
    }
    case TypeKind::kArray: {
      const Extent element = extent_of(type->element);
      const uint64_t bytes = uint64_t{element.bytes} * type->count;
      return {static_cast<uint32_t>(std::min<uint64_t>(bytes, kMaxValueBytes + 1)),
              element.alignment};
    }
    case TypeKind::kStruct:
      return layout_of(*type->structure).extent;
    case TypeKind::kResource:
      return type->is_query() ? Extent{sizeof(shader::RayQuery), alignof(shader::RayQuery)}
                              : Extent{32, 8};
  }
  return {};
}

uint32_t Layouts::field_offset(const Struct& structure, uint32_t field) {
  return layout_of(structure).offsets[field];
}

namespace {

const Type* innermost(const Type* type) {
  while (type->kind == TypeKind::kArray) type = type->element;
  return type;
}

// Follows memory.h and cpp/types.cpp: structs and arrays of structs are copied member by member.
// Anything else is one access, with the scalars counted from its aligned start.
class MoveCollector {
 public:
  MoveCollector(Layouts& layouts, ir::Layout layout, std::vector<Move>& out)
      : layouts_(layouts), layout_(layout), out_(out) {}

  void value(const Type* type, bool row_major, uint32_t memory, uint32_t at) {
    if (out_.size() > kMaxMoves) return;
    if (type->kind == TypeKind::kStruct) {
      const std::vector<uint32_t> offsets = field_offsets(*type->structure, layout_);
      for (uint32_t i = 0; i < offsets.size(); ++i) {
        const Field& field = type->structure->fields[i];
        value(field.type, field.row_major, memory + offsets[i],
              at + layouts_.field_offset(*type->structure, i));
      }
      return;
    }
    if (type->kind == TypeKind::kArray && innermost(type)->kind == TypeKind::kStruct) {
      const auto stride = static_cast<uint32_t>(array_stride(type->element, layout_, row_major));
      const uint32_t step = layouts_.extent_of(type->element).bytes;
      for (uint32_t i = 0; i < type->count; ++i) {
        value(type->element, row_major, memory + i * stride, at + i * step);
      }
      return;
    }
    member_ = memory;
    scalar_ = innermost(type)->scalar;
    member(type, row_major, 0, at);
  }

 private:
  void member(const Type* type, bool row_major, uint32_t memory, uint32_t at) {
    if (type->kind == TypeKind::kArray) {
      const auto stride = static_cast<uint32_t>(array_stride(type->element, layout_, row_major));
      const uint32_t step = layouts_.extent_of(type->element).bytes;
      for (uint32_t i = 0; i < type->count; ++i) {
        member(type->element, row_major, memory + i * stride, at + i * step);
      }
      return;
    }
    const uint32_t wide = scalar_bytes(scalar_, ScalarStorage::kBuffer);
    const uint32_t narrow = scalar_bytes(scalar_, ScalarStorage::kVariable);
    if (type->kind != TypeKind::kMatrix) {
      add(memory, at, component_count(type));
      return;
    }
    const uint32_t stride = matrix_stride(type, layout_, row_major);
    for (uint32_t r = 0; r < type->rows; ++r) {
      for (uint32_t c = 0; c < type->columns; ++c) {
        const uint32_t line = row_major ? r : c;
        const uint32_t place = row_major ? c : r;
        add(memory + line * stride + place * wide, at + (r * type->columns + c) * narrow, 1);
      }
    }
  }

  void add(uint32_t memory, uint32_t at, uint32_t count) {
    const bool is_bool = scalar_ == Scalar::kBool;
    const auto bytes = static_cast<uint8_t>(scalar_bytes(scalar_, ScalarStorage::kBuffer));
    if (!out_.empty()) {
      Move& last = out_.back();
      if (last.member == member_ && last.bytes == bytes && last.is_bool == is_bool &&
          last.at + last.count * bytes == memory &&
          last.value + last.count * scalar_bytes(scalar_, ScalarStorage::kVariable) == at) {
        last.count += count;
        return;
      }
    }
    out_.push_back({member_, ~((bytes < 4 ? bytes : 4u) - 1u), memory, at, count, bytes, is_bool});
  }

  Layouts& layouts_;
  ir::Layout layout_;
  std::vector<Move>& out_;
  uint32_t member_ = 0;
  Scalar scalar_ = Scalar::kFloat32;
};

}  // namespace

std::vector<Move> Layouts::moves_of(const Type* type, ir::Layout layout, bool row_major) {
  std::vector<Move> out;
  if (extent_of(type).bytes <= kMaxValueBytes) {
    MoveCollector(*this, layout, out).value(type, row_major, 0, 0);
  }
  return out;
}

}  // namespace kaamos::hlsl::interpret
