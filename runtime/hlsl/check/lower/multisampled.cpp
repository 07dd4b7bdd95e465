// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/multisampled.h"

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

// The statement that removes the device; what the use gives is zero.
Value Multisampled::multisampled_use(const Type* type, SourceLocation location) {
  at(location);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kRemoveDevice);
  statement->removal = ir::Removal::kMultisampled;
  body_.emit(statement);
  return rvalue(build_.zero(type->ir), type);
}

Value Multisampled::index_multisampled(const Value& base, const Value& index,
                                       SourceLocation location) {
  const bool is_sample = base.kind == ValueKind::kMips;
  if (is_sample && !base.offset) {
    const ir::Expr* sample = lower_.elements.index_value(index, location);
    if (!sample) return error_value();
    Value value = base;
    value.offset = build_.convert(sample, Scalar::kInt32);
    return value;
  }
  const Type* type = base.type;
  const ResourceTraits& traits = traits_of(type->resource);
  const bool fits =
      index.type && index.type->is_vector() && index.type->columns == traits.coordinates;
  if (!fits) {
    report(CheckId::kTexelIndex, location,
           {std::string(traits.name), std::to_string(traits.coordinates),
            index.type ? to_string(index.type) : "a resource"});
    return error_value();
  }
  if (!is_sample && !lower_.places.load(base)) return error_value();
  if (!lower_.resources.to_vector(index, Scalar::kUint32, traits.coordinates, location))
    return error_value();
  Value use = multisampled_use(type->element, location);
  use.is_const = true;
  if (!traits.is_writable) return use;
  // A write to this place goes nowhere.
  Value place = rvalue(build_.read(body_.empty_temporary(type->element->ir)), type->element);
  place.is_place = true;
  return place;
}

std::optional<Value> Multisampled::call_multisampled_method(const Value& object,
                                                            const NamePart& part,
                                                            std::vector<Value>& arguments,
                                                            SourceLocation location) {
  const Type* type = object.type;
  const ResourceTraits& traits = traits_of(type->resource);
  const std::string_view name = part.identifier;
  const auto output = [&](const Value& target, std::string_view what) {
    if (!lower_.places.require_place(target, target.location, what)) return false;
    lower_.places.store(
        target, lower_.conversions.convert(rvalue(build_.uint32(0), types_.scalar(Scalar::kUint32)),
                                           target.type, target.location));
    return true;
  };
  if (name == "GetDimensions") {
    const size_t outputs = traits.is_array ? 4 : 3;
    if (!lower_.intrinsics.check_count(name, arguments.size(), outputs, outputs, location))
      return error_value();
    if (!lower_.places.load(object)) return error_value();
    multisampled_use(type->element, location);
    for (const Value& target : arguments) {
      if (!output(target, "an output of GetDimensions")) return error_value();
    }
    return rvalue(build_.int32(0), types_.void_type());
  }
  const Type* int_type = types_.scalar(Scalar::kInt32);
  if (name == "GetSamplePosition") {
    if (!lower_.intrinsics.check_count(name, arguments.size(), 1, 1, location))
      return error_value();
    if (!lower_.places.load(object) ||
        !lower_.conversions.convert(arguments[0], int_type, arguments[0].location)) {
      return error_value();
    }
    return multisampled_use(types_.vector(Scalar::kFloat32, 2), location);
  }
  if (name != "Load") return std::nullopt;
  // Location, sample, then an offset unless the texture is writable, then a status.
  if (!lower_.intrinsics.check_count(name, arguments.size(), 2, traits.is_writable ? 3 : 4,
                                     location)) {
    return error_value();
  }
  if (!lower_.places.load(object) ||
      !lower_.resources.to_vector(arguments[0], Scalar::kInt32, traits.coordinates,
                                  arguments[0].location) ||
      !lower_.conversions.convert(arguments[1], int_type, arguments[1].location)) {
    return error_value();
  }
  size_t next = 2;
  if (!traits.is_writable && arguments.size() > next) {
    if (!lower_.resources.to_vector(arguments[next], Scalar::kInt32, 2, arguments[next].location)) {
      return error_value();
    }
    ++next;
  }
  const Value use = multisampled_use(type->element, location);
  if (arguments.size() > next && !output(arguments[next], "the status of a load")) {
    return error_value();
  }
  return use;
}

}  // namespace kaamos::hlsl
