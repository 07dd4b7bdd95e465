// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/types.h"

#include <algorithm>

#include "kaamos/shader/query_permissions.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

uint64_t flat_component_count(const Type* type) {
  constexpr uint64_t kMany = 1ull << 31;
  switch (type->kind) {
    case TypeKind::kNumeric:
      return type->components();
    case TypeKind::kArray:
      return std::min(kMany, flat_component_count(type->element) * std::max(type->count, 1u));
    case TypeKind::kStruct: {
      uint64_t count =
          type->structure->base ? flat_component_count(type->structure->base->type) : 0;
      for (const FieldInfo& field : type->structure->fields) {
        if (field.is_padding()) continue;
        count = std::min(kMany, count + flat_component_count(field.type));
      }
      return count;
    }
    default:
      return 1;
  }
}

namespace {

template <class Is>
bool contains(const Type* type, Is is) {
  if (is(type)) return true;
  if (type->is_array()) return contains(type->element, is);
  if (!type->is_struct()) return false;
  if (type->structure->base && contains(type->structure->base->type, is)) return true;
  return std::any_of(type->structure->fields.begin(), type->structure->fields.end(),
                     [is](const FieldInfo& field) { return contains(field.type, is); });
}

}  // namespace

bool contains_resource(const Type* type) {
  return contains(type, [](const Type* part) { return part->is_resource(); });
}

bool contains_hit_object(const Type* type) {
  return contains(type, [](const Type* part) { return part->is_hit_object(); });
}

bool contains_long_vector(const Type* type) {
  return contains(type, [](const Type* part) { return part->is_long_vector(); });
}

TypeTable::TypeTable(IrTypes& ir) : ir_(ir) {
  Type* error_type = make(TypeKind::kError);
  error_type->ir = ir_.void_type();
  error_ = error_type;
  Type* void_type = make(TypeKind::kVoid);
  void_type->ir = ir_.void_type();
  void_ = void_type;
  string_ = make(TypeKind::kString);
}

Type* TypeTable::make(TypeKind kind) {
  Type* type = &pool_.emplace_back();
  type->kind = kind;
  type->canonical = type;
  return type;
}

const Type* TypeTable::numeric(Scalar scalar, uint32_t rows, uint32_t columns, bool row_major) {
  if (rows == 0 && columns == 1) columns = 0;
  if (rows == 0) row_major = false;
  const uint32_t key =
      static_cast<uint32_t>(scalar) << 24 | rows << 16 | columns << 1 | (row_major ? 1u : 0u);
  if (auto found = numeric_.find(key); found != numeric_.end()) return found->second;
  const Type* canonical = row_major ? numeric(scalar, rows, columns, false) : nullptr;
  Type* type = make(TypeKind::kNumeric);
  type->scalar = scalar;
  type->rows = static_cast<uint8_t>(rows);
  type->columns = static_cast<uint16_t>(columns);
  type->row_major = row_major;
  if (canonical) type->canonical = canonical;
  type->ir = ir_.numeric(plain_scalar(scalar), rows, columns);
  numeric_[key] = type;
  return type;
}

const Type* TypeTable::single(Scalar scalar_kind) {
  const Type*& slot = singles_[scalar_kind];
  if (slot) return slot;
  Type* type = make(TypeKind::kNumeric);
  type->scalar = scalar_kind;
  type->is_single = true;
  type->canonical = scalar(scalar_kind);
  type->ir = type->canonical->ir;
  return slot = type;
}

const Type* TypeTable::with_scalar(const Type* shape, Scalar scalar) {
  return numeric(scalar, shape->rows, shape->columns, shape->row_major);
}

const Type* TypeTable::plain(const Type* type) {
  if (type->is_array()) return array(plain(type->element), type->count);
  return type->is_numeric() ? with_scalar(type, plain_scalar(type->scalar)) : type;
}

const Type* TypeTable::settled(const Type* type) {
  if (type->is_numeric() && type->scalar == Scalar::kLiteralInt) {
    return with_scalar(type, Scalar::kInt32);
  }
  if (type->is_numeric() && type->scalar == Scalar::kLiteralFloat) {
    return with_scalar(type, Scalar::kFloat32);
  }
  return type;
}

const Type* TypeTable::array(const Type* element, uint32_t count) {
  const Type*& slot = arrays_[{element, count}];
  if (slot) return slot;
  const Type* canonical =
      element->canonical != element ? array(element->canonical, count) : nullptr;
  Type* type = make(TypeKind::kArray);
  type->element = element;
  type->count = count;
  if (canonical) {
    type->canonical = canonical;
    type->ir = canonical->ir;
  } else {
    type->ir = ir_.array(element->ir, count);
  }
  return arrays_[{element, count}] = type;
}

const Type* TypeTable::resource(ir::ResourceKind kind, const Type* element, bool written) {
  const Type*& slot = resources_[{kind, element, written}];
  if (slot) return slot;
  const Type* canonical = nullptr;
  if (element && (element->canonical != element || !written)) {
    canonical = resource(kind, element->canonical, true);
  }
  Type* type = make(TypeKind::kResource);
  type->resource = kind;
  type->element = element;
  type->has_written_element = written && element != nullptr;
  if (canonical) {
    type->canonical = canonical;
    type->ir = canonical->ir;
  } else {
    const ir::Type* ir_element = element ? element->ir : nullptr;
    if (is_typed(kind)) ir_element = texel_of(element)->ir;
    type->ir = ir_.resource(kind, ir_element);
  }
  return resources_[{kind, element, written}] = type;
}

const Type* TypeTable::texel_of(const Type* element) {
  if (!has_paired_texel(element)) return element;
  const Scalar half = element->scalar == Scalar::kInt64 ? Scalar::kInt32 : Scalar::kUint32;
  return vector(half, 2 * element->components());
}

const Type* TypeTable::ray_query(uint32_t flags) {
  const Type*& slot = ray_queries_[flags];
  if (slot) return slot;
  Type* type = make(TypeKind::kResource);
  type->resource = ir::ResourceKind::kRayQuery;
  type->ray_query_flags = flags;
  type->ir = ir_.ray_query(flags);
  slot = type;
  return slot;
}

const Type* TypeTable::structure(StructInfo* info) {
  Type* type = make(TypeKind::kStruct);
  type->structure = info;
  type->ir = ir_.structure(info->ir);
  info->type = type;
  return type;
}

void TypeTable::share(StructInfo* info, const StructInfo& other) {
  const auto own = std::find_if(pool_.begin(), pool_.end(),
                                [&](const Type& type) { return &type == info->type; });
  own->ir = other.type->ir;
  info->ir = other.ir;
}

const Type* TypeTable::enumeration(EnumInfo* info) {
  Type* type = make(TypeKind::kEnum);
  type->enumeration = info;
  type->scalar = info->underlying;
  type->ir = scalar(info->underlying)->ir;
  return type;
}

std::string to_string(const Type* type) {
  switch (type->kind) {
    case TypeKind::kError:
      return "<error>";
    case TypeKind::kVoid:
      return "void";
    case TypeKind::kString:
      return "string";
    case TypeKind::kEnum:
      return type->enumeration->name;
    case TypeKind::kStruct:
      return type->structure->name;
    case TypeKind::kNumeric: {
      std::string text(name_of(type->scalar));
      if (type->rows) {
        return (type->row_major ? "row_major " : "") + text + std::to_string(type->rows) + "x" +
               std::to_string(type->columns);
      }
      if (type->is_long_vector()) {
        return "vector<" + text + ", " + std::to_string(type->columns) + ">";
      }
      if (type->columns) text += std::to_string(type->columns);
      if (type->is_single) text += '1';
      return text;
    }
    case TypeKind::kArray: {
      std::string bounds;
      const Type* element = type;
      for (; element->is_array(); element = element->element) {
        bounds += "[" + (element->count ? std::to_string(element->count) : std::string()) + "]";
      }
      return to_string(element) + bounds;
    }
    case TypeKind::kResource: {
      std::string text(resource_name(type->resource));
      if (type->is_query()) {
        const uint32_t flags = type->ray_query_flags;
        const uint32_t second = shader::query_flags_of(flags);
        text += "<" + std::to_string(flags & ~shader::kRayQueryPermissions);
        text += second != 0 ? ", " + std::to_string(second) + ">" : ">";
      }
      if (type->element && type->resource != ir::ResourceKind::kByteAddressBuffer &&
          type->resource != ir::ResourceKind::kRWByteAddressBuffer) {
        text += "<" + to_string(type->element) + ">";
      }
      return text;
    }
  }
  return {};
}

}  // namespace kaamos::hlsl
