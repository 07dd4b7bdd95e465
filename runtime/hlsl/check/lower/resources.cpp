// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/resources.h"

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_functions.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

Value Resources::texel(const ir::Expr* resource, const Type* type, const ir::Expr* coordinates,
                       const ir::Expr* mip, bool is_const) {
  Value value;
  value.kind = ValueKind::kTyped;
  value.type = type->element;
  value.is_place = !is_const;
  value.is_const = is_const;
  value.expr = resource;
  value.coordinates = coordinates;
  value.mip = mip;
  return value;
}

const ir::Expr* Resources::to_vector(const Value& value, Scalar scalar, uint32_t size,
                                     SourceLocation location) {
  if (value.failed()) return nullptr;
  const Type* type = types_.vector(scalar, size);
  return lower_.conversions.convert(value, type, location);
}

Value Resources::index_resource(const Value& base, const Value& index, SourceLocation location) {
  const bool is_mips = base.kind == ValueKind::kMips;
  const Type* type = base.type;
  const ResourceTraits& traits = traits_of(type->resource);
  if (is_multisampled(type->resource))
    return lower_.multisampled.index_multisampled(base, index, location);
  if (is_mips && !base.offset) {
    const ir::Expr* level = lower_.elements.index_value(index, location);
    if (!level) return error_value();
    Value value = base;
    value.offset = build_.convert(level, Scalar::kInt32);
    return value;
  }
  const ir::Expr* resource = is_mips ? base.expr : lower_.places.load(base);
  if (!resource) return error_value();
  if (is_structured(type->resource)) {
    const ir::Expr* element = lower_.elements.index_value(index, location);
    if (!element) return error_value();
    return memory(resource, build_.convert(element, Scalar::kUint32), build_.uint32(0),
                  type->element, ir::Layout::kStructured, !traits.is_writable);
  }
  const bool is_cube = type->resource == ir::ResourceKind::kTextureCube ||
                       type->resource == ir::ResourceKind::kTextureCubeArray;
  if (!is_typed(type->resource) || is_cube) {
    report(CheckId::kNotIndexable, location, {to_string(type)});
    return error_value();
  }
  const bool is_unsigned = index.type && index.type->is_numeric() &&
                           plain_scalar(index.type->scalar) != Scalar::kInt32 &&
                           index.type->scalar != Scalar::kLiteralInt;
  if (index.type && index.type->is_vector() && index.type->columns > traits.coordinates) {
    report(
        CheckId::kTextureIndex, location,
        {to_string(type), std::to_string(index.type->columns), std::to_string(traits.coordinates)});
  }
  const ir::Expr* coordinates = to_vector(index, is_unsigned ? Scalar::kUint32 : Scalar::kInt32,
                                          traits.coordinates, location);
  if (!coordinates) return error_value();
  const ir::Expr* mip = nullptr;
  if (is_mips) {
    mip = base.offset;
  } else if (is_sampled_texture(type->resource)) {
    mip = build_.int32(0);
  }
  return texel(resource, type, coordinates, mip, !traits.is_writable);
}

Value Resources::call_resource_method(const Value& object, const NamePart& part,
                                      std::vector<Value>& arguments, SourceLocation location) {
  lower_.body_rules.check_model(part.identifier, location);
  const Type* type = object.type;
  const std::string_view name = part.identifier;
  const ResourceTraits& traits = traits_of(type->resource);
  if (is_multisampled(type->resource)) {
    if (auto result =
            lower_.multisampled.call_multisampled_method(object, part, arguments, location))
      return *result;
  } else if (name == "GetDimensions" && !is_sampler(type->resource) &&
             type->resource != ir::ResourceKind::kAccelerationStructure) {
    return lower_.textures.call_dimensions(object, arguments, location);
  }
  if (is_raw(type->resource)) {
    if (auto result = call_raw_method(object, part, arguments, location)) return *result;
  } else if (is_structured(type->resource)) {
    if (name == "Load") {
      if (!lower_.intrinsics.check_count("Load", arguments.size(), 1, 2, location))
        return error_value();
      Value value = index_resource(object, arguments[0], location);
      value.is_place = false;
      return arguments.size() == 2 ? lower_.textures.with_status(value, arguments[1]) : value;
    }
    if (auto result = lower_.counters.call_counter_method(object, name, arguments, location))
      return *result;
  } else if (has_elements(type->resource)) {
    if (auto result = lower_.counters.call_counter_method(object, name, arguments, location))
      return *result;
  } else if (is_typed(type->resource)) {
    if (auto result = lower_.textures.call_texture_method(object, part, arguments, location))
      return *result;
  }
  report(CheckId::kNoSuchMethod, location, {std::string(traits.name), std::string(name)});
  return error_value();
}

std::optional<Value> Resources::call_raw_method(const Value& object, const NamePart& part,
                                                std::vector<Value>& arguments,
                                                SourceLocation location) {
  std::string_view name = part.identifier;
  const bool writable = traits_of(object.type->resource).is_writable;
  const AtomicRule* atomic = writable ? find_atomic(name) : nullptr;
  const bool is_load = name.starts_with("Load");
  const bool is_store = writable && name.starts_with("Store");
  if (!atomic && !is_load && !is_store) {
    if (!unsupported_function(name).empty()) {
      report(CheckId::kUnsupported, location,
             {"'" + std::string(name) + "' (" + std::string(unsupported_function(name)) + ")"});
      return error_value();
    }
    return std::nullopt;
  }
  const ir::Expr* resource = lower_.places.load(object);
  if (!resource) return error_value();
  if (atomic) {
    const size_t fixed = 2 + (atomic->has_compare ? 1 : 0);
    if (!lower_.intrinsics.check_count(name, arguments.size(),
                                       fixed + (atomic->needs_result ? 1 : 0),
                                       fixed + (atomic->has_result ? 1 : 0), location)) {
      return error_value();
    }
    const ir::Expr* offset = lower_.elements.index_value(arguments[0], location);
    if (!offset) return error_value();
    const bool wide = name.ends_with("64");
    ir::Stmt* statement = build_.stmt(ir::StmtKind::kAtomic);
    statement->target = ir::AtomicTarget::kMemory;
    statement->operands = {resource, build_.convert(offset, Scalar::kUint32)};
    if (atomic->on_floats) {
      return lower_.atomics.emit_atomic(*atomic, statement, types_.scalar(Scalar::kFloat32), true,
                                        std::span(arguments).subspan(1), location);
    }
    // The memory has no type: the value's sign counts.
    const Type* type = lower_.atomics.any_integer(arguments[1].type, wide ? 8 : 4);
    return lower_.atomics.emit_atomic(*atomic, statement, type, true,
                                      std::span(arguments).subspan(1), location);
  }
  name.remove_prefix(is_load ? 4 : 5);
  const bool plain = name.empty();
  if (!plain && !(name == "2" || name == "3" || name == "4")) return std::nullopt;
  const uint32_t size = plain ? 1 : static_cast<uint32_t>(name[0] - '0');
  const Type* type = types_.vector(Scalar::kUint32, size);
  const size_t count = is_load ? 1 : 2;
  if (!lower_.intrinsics.check_count(part.identifier, arguments.size(), count, 2, location)) {
    return error_value();
  }
  if (part.has_template_arguments) {
    if (!plain || part.template_arguments.size() != 1) {
      report(CheckId::kNotATemplate, location, {std::string(part.identifier)});
      return error_value();
    }
    type = names_.type_argument(part.template_arguments[0], body_.scope);
    if (type->is_error()) return error_value();
  } else if (is_store && plain) {
    // Store takes any type; Store<T> names it explicitly.
    Value settled_value = lower_.conversions.settle(arguments[1]);
    if (!settled_value.type || settled_value.failed()) {
      report(CheckId::kInitListUse, location);
      return error_value();
    }
    type = settled_value.type->is_numeric() && settled_value.type->is_scalar() &&
                   scalar_bytes(settled_value.type->scalar, ScalarStorage::kBuffer) == 4 &&
                   plain_scalar(settled_value.type->scalar) != Scalar::kFloat32
               ? types_.scalar(Scalar::kUint32)
               : settled_value.type;
  }
  if (contains_hit_object(type)) {
    report(CheckId::kHitObjectPlace, location, {std::string(part.identifier)});
    return error_value();
  }
  if (contains_resource(type) || type->is_void() || (type->is_array() && type->count == 0)) {
    report(CheckId::kElementType, location,
           {std::string(part.identifier), "a type without resources", to_string(type)});
    return error_value();
  }
  const ir::Expr* offset = lower_.elements.index_value(arguments[0], arguments[0].location);
  if (!offset) return error_value();
  at(location);
  Value target = memory(resource, nullptr, build_.convert(offset, Scalar::kUint32), type,
                        ir::Layout::kStructured, !writable);
  if (is_load) {
    target.is_place = false;
    return arguments.size() == 2 ? lower_.textures.with_status(target, arguments[1]) : target;
  }
  const ir::Expr* value = lower_.conversions.convert(arguments[1], type, arguments[1].location);
  if (!value) return error_value();
  at(location);
  lower_.places.store(target, value);
  return rvalue(build_.int32(0), types_.void_type());
}

}  // namespace kaamos::hlsl
