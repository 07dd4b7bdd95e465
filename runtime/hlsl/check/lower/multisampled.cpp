// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/multisampled.h"

#include <bit>

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

Value Multisampled::texel(const ir::Expr* resource, const Type* type, const ir::Expr* coordinates,
                          const ir::Expr* sample, const ir::Expr* offset, SourceLocation location) {
  at(location);
  ir::Expr* raw = build_.expr(ir::ExprKind::kTypedLoad, types_.texel_of(type->element)->ir,
                              {resource, coordinates, sample});
  if (offset) raw->operands.push_back(offset);
  return rvalue(lower_.textures.from_texel(raw, type->element), type->element);
}

Value Multisampled::dimensions(const Value& object, std::vector<Value>& arguments,
                               SourceLocation location) {
  const bool is_array = traits_of(object.type->resource).is_array;
  const std::vector<uint8_t> outputs =
      is_array ? std::vector<uint8_t>{0, 1, 2, 3} : std::vector<uint8_t>{0, 1, 3};
  if (!lower_.intrinsics.check_count("GetDimensions", arguments.size(), outputs.size(),
                                     outputs.size(), location)) {
    return error_value();
  }
  const ir::Expr* resource = lower_.places.load(object);
  if (!resource) return error_value();
  at(location);
  const Type* number = types_.scalar(Scalar::kUint32);
  const ir::Expr* all = build_.read(
      body_.temporary(build_.expr(ir::ExprKind::kDimensions, types_.vector(Scalar::kUint32, 4)->ir,
                                  {resource, build_.uint32(0)})));
  for (size_t i = 0; i < outputs.size(); ++i) {
    Value& target = arguments[i];
    if (!lower_.places.require_place(target, target.location, "an output of GetDimensions")) {
      return error_value();
    }
    const Value value = rvalue(build_.swizzle(all, {outputs[i]}), number);
    lower_.places.store(target, lower_.conversions.convert(value, target.type, target.location));
  }
  return rvalue(build_.int32(0), types_.void_type());
}

// Four bits for each sample: sixteenths of a pixel from the middle, and 8 more.
// [D3D11.3: 19.2.4 Standard sample patterns]
const ir::Expr* Multisampled::sample_position(const ir::Expr* count, const ir::Expr* index) {
  struct Pattern {
    uint32_t count, x, y;
  };
  constexpr Pattern kPatterns[] = {
      {2, 0x4C, 0x4C}, {4, 0xA2E6, 0xEA62}, {8, 0xFB135D79, 0x1F7D39B5}};
  const ir::Expr* samples = build_.read(body_.temporary(count));
  const ir::Expr* which = build_.read(body_.temporary(index));
  const auto select = [&](const ir::Expr* condition, const ir::Expr* then, const ir::Expr* other) {
    return build_.expr(ir::ExprKind::kSelect, then->type, {condition, then, other});
  };
  const auto number = [&](double value) {
    return build_.literal(build_.scalar_type(Scalar::kFloat32), {std::bit_cast<uint64_t>(value)});
  };
  const ir::Expr* parts[2] = {};
  for (uint32_t axis = 0; axis < 2; ++axis) {
    const ir::Expr* pattern = build_.uint32(8);
    for (const Pattern& one : kPatterns) {
      pattern = select(build_.binary(ir::BinaryOp::kEqual, samples, build_.uint32(one.count)),
                       build_.uint32(axis == 0 ? one.x : one.y), pattern);
    }
    const ir::Expr* shift = build_.binary(ir::BinaryOp::kMultiply, which, build_.uint32(4));
    const ir::Expr* bits =
        build_.binary(ir::BinaryOp::kBitAnd,
                      build_.binary(ir::BinaryOp::kShiftRight, pattern, shift), build_.uint32(15));
    bits = select(build_.binary(ir::BinaryOp::kLess, which, samples), bits, build_.uint32(8));
    const ir::Expr* steps =
        build_.binary(ir::BinaryOp::kSubtract, build_.convert(bits, Scalar::kFloat32), number(8));
    parts[axis] = build_.binary(ir::BinaryOp::kMultiply, steps, number(1.0 / 16));
  }
  return build_.construct(build_.vector_type(Scalar::kFloat32, 2), {parts[0], parts[1]});
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
  const ir::Expr* resource = is_sample ? base.expr : lower_.places.load(base);
  if (!resource) return error_value();
  const ir::Expr* coordinates =
      lower_.resources.to_vector(index, Scalar::kUint32, traits.coordinates, location);
  if (!coordinates) return error_value();
  if (!traits.is_writable) {
    const ir::Expr* sample = is_sample ? base.offset : build_.int32(0);
    Value value = texel(resource, type, coordinates, sample, nullptr, location);
    value.is_const = true;
    return value;
  }
  Value use = multisampled_use(type->element, location);
  use.is_const = true;
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
  if (name == "GetDimensions" && !traits.is_writable) {
    return dimensions(object, arguments, location);
  }
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
    const ir::Expr* resource = lower_.places.load(object);
    const ir::Expr* sample =
        lower_.conversions.convert(arguments[0], int_type, arguments[0].location);
    if (!resource || !sample) return error_value();
    const Type* position = types_.vector(Scalar::kFloat32, 2);
    if (traits.is_writable) return multisampled_use(position, location);
    at(location);
    const ir::Expr* all =
        build_.expr(ir::ExprKind::kDimensions, types_.vector(Scalar::kUint32, 4)->ir,
                    {resource, build_.uint32(0)});
    const ir::Expr* count = build_.swizzle(build_.read(body_.temporary(all)), {3});
    return rvalue(sample_position(count, build_.convert(sample, Scalar::kUint32)), position);
  }
  if (name != "Load") return std::nullopt;
  // Location, sample, then an offset unless the texture is writable, then a status.
  if (!lower_.intrinsics.check_count(name, arguments.size(), 2, traits.is_writable ? 3 : 4,
                                     location)) {
    return error_value();
  }
  const ir::Expr* resource = lower_.places.load(object);
  if (!resource) return error_value();
  const ir::Expr* coordinates = lower_.resources.to_vector(
      arguments[0], Scalar::kInt32, traits.coordinates, arguments[0].location);
  if (!coordinates) return error_value();
  const ir::Expr* sample =
      lower_.conversions.convert(arguments[1], int_type, arguments[1].location);
  if (!sample) return error_value();
  size_t next = 2;
  const ir::Expr* offset = nullptr;
  if (!traits.is_writable && arguments.size() > next) {
    offset =
        lower_.resources.to_vector(arguments[next], Scalar::kInt32, 2, arguments[next].location);
    if (!offset) return error_value();
    ++next;
  }
  if (!traits.is_writable) {
    const Value value = texel(resource, type, coordinates, sample, offset, location);
    return arguments.size() > next ? lower_.textures.with_status(value, arguments[next]) : value;
  }
  const Value use = multisampled_use(type->element, location);
  if (arguments.size() > next && !output(arguments[next], "the status of a load")) {
    return error_value();
  }
  return use;
}

}  // namespace kaamos::hlsl
