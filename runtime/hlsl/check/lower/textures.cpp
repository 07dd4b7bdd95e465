// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/textures.h"

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/layout.h"
#include "runtime/hlsl/ir/builtin_functions.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

std::optional<Value> Textures::call_texture_method(const Value& object, const NamePart& part,
                                                   std::vector<Value>& arguments,
                                                   SourceLocation location) {
  const std::string_view name = part.identifier;
  const bool sampled = is_sampled_texture(object.type->resource);
  if (name == "Load") return call_load(object, arguments, location);
  if (!sampled) return std::nullopt;
  if (name == "CalculateLevelOfDetail" || name == "CalculateLevelOfDetailUnclamped") {
    return lower_.pixel_intrinsics.call_level_of_detail(object, !name.ends_with("Unclamped"),
                                                        arguments, location);
  }
  if (const SampleRule* rule = find_sample(name)) {
    return call_sample(object, *rule, arguments, location);
  }
  if (name.starts_with("Gather") || name.starts_with("Sample")) {
    report(CheckId::kUnsupported, location, {"'" + std::string(name) + "'"});
    return error_value();
  }
  return std::nullopt;
}

Value Textures::call_load(const Value& object, std::vector<Value>& arguments,
                          SourceLocation location) {
  const Type* type = object.type;
  const ResourceTraits& traits = traits_of(type->resource);
  const bool sampled = is_sampled_texture(type->resource);
  if (type->resource == ir::ResourceKind::kTextureCube ||
      type->resource == ir::ResourceKind::kTextureCubeArray) {
    report(CheckId::kNoSuchMethod, location, {std::string(traits.name), "Load"});
    return error_value();
  }
  const size_t highest = sampled ? 3 : 2;
  if (!lower_.intrinsics.check_count("Load", arguments.size(), 1, highest, location))
    return error_value();
  if (arguments.size() == highest) {
    Value status = arguments.back();
    arguments.pop_back();
    return with_status(call_load(object, arguments, location), status);
  }
  const ir::Expr* resource = lower_.places.load(object);
  if (!resource) return error_value();
  if (!sampled) {
    const ir::Expr* coordinates = lower_.resources.to_vector(
        arguments[0], Scalar::kInt32, traits.coordinates, arguments[0].location);
    if (!coordinates) return error_value();
    Value value = lower_.resources.texel(resource, type, coordinates, nullptr, true);
    value.is_place = false;
    return value;
  }
  // The last component of the location is the mip level.
  const ir::Expr* all = lower_.resources.to_vector(arguments[0], Scalar::kInt32,
                                                   traits.coordinates + 1u, arguments[0].location);
  if (!all) return error_value();
  at(location);
  all = body_.repeatable(all);
  std::vector<uint8_t> components;
  for (uint8_t i = 0; i < traits.coordinates; ++i) components.push_back(i);
  const ir::Expr* coordinates = build_.swizzle(all, components);
  const ir::Expr* mip = build_.swizzle(all, {traits.coordinates});
  if (arguments.size() == 2) {
    const uint32_t size = traits.coordinates - (traits.is_array ? 1u : 0u);
    const ir::Expr* offset =
        lower_.resources.to_vector(arguments[1], Scalar::kInt32, size, arguments[1].location);
    if (!offset) return error_value();
    check_offset(offset, arguments[1].location);
    at(location);
    const ir::Expr* raw = build_.expr(ir::ExprKind::kTypedLoad, types_.texel_of(type->element)->ir,
                                      {resource, coordinates, mip, offset});
    return rvalue(from_texel(raw, type->element), type->element);
  }
  Value value = lower_.resources.texel(resource, type, coordinates, mip, true);
  value.is_place = false;
  return value;
}

Value Textures::call_sample(const Value& object, const SampleRule& rule,
                            std::vector<Value>& arguments, SourceLocation location) {
  using F = SampleForm;
  const Type* type = object.type;
  const ResourceTraits& traits = traits_of(type->resource);
  const uint32_t dimensions = traits.coordinates - (traits.is_array ? 1u : 0u);
  const bool compares = rule.form == F::kCompare || rule.form == F::kCompareZero ||
                        rule.form == F::kCompareLevel || rule.form == F::kCompareBias ||
                        rule.form == F::kCompareGradient || rule.form == F::kGatherCompare;
  const bool from_quad = rule.form == F::kSample || rule.form == F::kBias ||
                         rule.form == F::kCompare || rule.form == F::kCompareBias;
  const bool from_gradient = rule.form == F::kGradient || rule.form == F::kCompareGradient;
  const bool gathers = rule.form == F::kGather || rule.form == F::kGatherCompare;
  const bool is_cube = type->resource == ir::ResourceKind::kTextureCube ||
                       type->resource == ir::ResourceKind::kTextureCubeArray;
  if (has_paired_texel(type->element)) {
    report(CheckId::kSampledPairs, location, {to_string(type), std::string(rule.name)});
    return error_value();
  }
  if (gathers && !is_cube && dimensions != 2) {
    report(CheckId::kNoSuchMethod, location, {std::string(traits.name), std::string(rule.name)});
    return error_value();
  }
  // Sampler, location and the operands of the form; then an offset, if the texture takes one.
  size_t fixed = 2;
  if (rule.form == F::kCompareGradient) {
    fixed = 5;
  } else if (rule.form == F::kGradient || rule.form == F::kCompareLevel ||
             rule.form == F::kCompareBias) {
    fixed = 4;
  } else if (rule.form != F::kSample && rule.form != F::kGather) {
    fixed = 3;
  }
  const size_t offsets = is_cube ? 0 : 1;
  const bool has_clamp = from_quad || from_gradient;
  const size_t clamp_at = fixed + offsets;
  const size_t status_at = clamp_at + (has_clamp ? 1 : 0);
  const bool has_channel =
      gathers && !is_cube && !rule.name.ends_with("Gather") && !rule.name.ends_with("Cmp");
  if (has_channel && arguments.size() >= fixed + 4) {
    return gather_four(object, rule, arguments, fixed, location);
  }
  if (!lower_.intrinsics.check_count(rule.name, arguments.size(), fixed, status_at + 1, location)) {
    return error_value();
  }
  if (arguments.size() == status_at + 1) {
    Value status = arguments.back();
    arguments.pop_back();
    return with_status(call_sample(object, rule, arguments, location), status);
  }
  const Value* clamp = has_clamp && arguments.size() > clamp_at ? &arguments[clamp_at] : nullptr;
  const auto sampler_kind =
      compares ? ir::ResourceKind::kSamplerComparison : ir::ResourceKind::kSampler;
  const ir::Expr* resource = lower_.places.load(object);
  const ir::Expr* sampler = lower_.conversions.convert(
      arguments[0], types_.resource(sampler_kind, nullptr), arguments[0].location);
  const ir::Expr* coordinates = lower_.resources.to_vector(
      arguments[1], Scalar::kFloat32, traits.coordinates, arguments[1].location);
  if (!resource || !sampler || !coordinates) return error_value();
  at(location);
  if (from_gradient) coordinates = body_.repeatable(coordinates);
  std::vector<const ir::Expr*> operands = {resource, sampler, coordinates};
  const auto scalar_operand = [&](size_t index) {
    operands.push_back(lower_.conversions.convert(arguments[index], types_.scalar(Scalar::kFloat32),
                                                  arguments[index].location));
  };
  const auto zero_level = [&] {
    operands.push_back(build_.zero(types_.scalar(Scalar::kFloat32)->ir));
  };
  const auto gradient = [&](size_t index) {
    return lower_.resources.to_vector(arguments[index], Scalar::kFloat32, dimensions,
                                      arguments[index].location);
  };
  const auto level_of_gradient = [&](size_t index) -> const ir::Expr* {
    const ir::Expr* ddx = gradient(index);
    const ir::Expr* ddy = gradient(index + 1);
    const Type* real = types_.scalar(Scalar::kFloat32);
    const ir::Expr* least =
        clamp ? lower_.conversions.convert(*clamp, real, clamp->location) : nullptr;
    if (!ddx || !ddy || (clamp && !least)) return nullptr;
    ir::Expr* level =
        build_.expr(ir::ExprKind::kSample, real->ir, {resource, sampler, coordinates, ddx, ddy});
    level->sample = ir::SampleKind::kLevelOfDetail;
    return least ? build_.intrinsic(Intrinsic::max, real->ir, {level, least}) : level;
  };
  ir::SampleKind kind = ir::SampleKind::kLevel;
  switch (rule.form) {
    case F::kSample:
      zero_level();
      break;
    case F::kBias:
    case F::kLevel:
      scalar_operand(2);
      break;
    case F::kGradient:
      if (clamp) {
        operands.push_back(level_of_gradient(2));
        break;
      }
      kind = ir::SampleKind::kGradient;
      for (const size_t i : {2, 3}) operands.push_back(gradient(i));
      break;
    case F::kCompare:
    case F::kCompareZero:
      kind = ir::SampleKind::kCompareLevel;
      scalar_operand(2);
      zero_level();
      break;
    case F::kCompareGradient:
      kind = ir::SampleKind::kCompareLevel;
      scalar_operand(2);
      operands.push_back(level_of_gradient(3));
      break;
    case F::kCompareBias:
    case F::kCompareLevel:
      kind = ir::SampleKind::kCompareLevel;
      scalar_operand(2);
      scalar_operand(3);
      break;
    case F::kGather:
      kind = ir::SampleKind::kGather;
      break;
    case F::kGatherCompare:
      kind = ir::SampleKind::kGatherCompare;
      scalar_operand(2);
      break;
  }
  if (offsets && arguments.size() > fixed) {
    operands.push_back(lower_.resources.to_vector(arguments[fixed], Scalar::kInt32, dimensions,
                                                  arguments[fixed].location));
    if (!gathers) check_offset(operands.back(), arguments[fixed].location);
  }
  if (clamp && from_quad)
    operands.push_back(
        lower_.conversions.convert(*clamp, types_.scalar(Scalar::kFloat32), clamp->location));
  for (const ir::Expr* operand : operands) {
    if (!operand) return error_value();
  }
  at(location);
  const Type* result = gathers    ? types_.vector(type->element->scalar, 4)
                       : compares ? types_.scalar(Scalar::kFloat32)
                                  : type->element;
  ir::Expr* node = build_.expr(ir::ExprKind::kSample, result->ir);
  node->operands = std::move(operands);
  node->sample = kind;
  node->index = rule.component;
  if (from_quad) {
    node->clamps_level = clamp != nullptr;
    lower_.pixel_intrinsics.use_implicit_level(rule.name, node, location);
  }
  return rvalue(node, result);
}

// A known offset is one that an instruction can hold. [DXC]
void Textures::check_offset(const ir::Expr* offset, SourceLocation location) {
  const auto bits = offset ? evaluate(offset) : std::nullopt;
  if (!bits) return;
  for (const uint64_t component : *bits) {
    const int64_t number = static_cast<int64_t>(component);
    if (number >= -8 && number <= 7) continue;
    report(CheckId::kTexelOffset, location, {std::to_string(number)});
    return;
  }
}

// Component i of the result comes from the texels at offset i.
Value Textures::gather_four(const Value& object, const SampleRule& rule,
                            std::vector<Value>& arguments, size_t fixed, SourceLocation location) {
  if (!lower_.intrinsics.check_count(rule.name, arguments.size(), fixed + 4, fixed + 5, location)) {
    return error_value();
  }
  if (arguments.size() == fixed + 5) {
    Value status = arguments.back();
    arguments.pop_back();
    return with_status(gather_four(object, rule, arguments, fixed, location), status);
  }
  std::vector<const ir::Expr*> parts;
  const Type* type = nullptr;
  for (uint8_t i = 0; i < 4; ++i) {
    std::vector<Value> one(arguments.begin(),
                           arguments.begin() + static_cast<std::ptrdiff_t>(fixed));
    one.push_back(arguments[fixed + i]);
    const Value gathered = call_sample(object, rule, one, location);
    if (gathered.failed()) return error_value();
    type = gathered.type;
    parts.push_back(build_.swizzle(build_.read(body_.temporary(gathered.expr)), {i}));
  }
  return rvalue(build_.construct(type->ir, std::move(parts)), type);
}

// Every resource is mapped completely.
Value Textures::with_status(const Value& result, Value& status) {
  if (result.failed()) return result;
  const ir::Expr* value = lower_.places.load(result);
  if (!value || !lower_.places.require_place(status, status.location, "the status of a load")) {
    return error_value();
  }
  const Type* type = result.type;
  value = build_.read(body_.temporary(value));
  lower_.places.store(
      status, lower_.conversions.convert(rvalue(build_.uint32(1), types_.scalar(Scalar::kUint32)),
                                         status.type, status.location));
  return rvalue(value, type);
}

Value Textures::call_dimensions(const Value& object, std::vector<Value>& arguments,
                                SourceLocation location) {
  using K = ir::ResourceKind;
  const Type* type = object.type;
  const ResourceTraits& traits = traits_of(type->resource);
  // For each output, the component of ir::ExprKind::kDimensions that goes to it.
  std::vector<uint8_t> outputs;
  bool has_mips = is_sampled_texture(type->resource);
  if (has_elements(type->resource)) {
    outputs = {0, 1};
  } else if (!is_texture(type->resource)) {
    outputs = {0};
  } else {
    outputs = {0};
    const uint32_t dimensions = traits.coordinates - (traits.is_array ? 1u : 0u);
    if (dimensions >= 2) outputs.push_back(1);
    if (type->resource == K::kTexture3D || type->resource == K::kRWTexture3D || traits.is_array) {
      outputs.push_back(2);
    }
  }
  const bool with_mip = has_mips && arguments.size() == outputs.size() + 2;
  if (!with_mip && !lower_.intrinsics.check_count("GetDimensions", arguments.size(), outputs.size(),
                                                  outputs.size(), location)) {
    return error_value();
  }
  const ir::Expr* resource = lower_.places.load(object);
  if (!resource) return error_value();
  ir::Expr* node =
      build_.expr(ir::ExprKind::kDimensions, types_.vector(Scalar::kUint32, 4)->ir, {resource});
  if (has_mips) {
    const ir::Expr* mip = build_.uint32(0);
    if (with_mip) {
      mip = lower_.conversions.convert(arguments[0], types_.scalar(Scalar::kUint32),
                                       arguments[0].location);
      outputs.push_back(3);
    }
    if (!mip) return error_value();
    node->operands.push_back(mip);
  }
  at(location);
  const ir::Expr* all = build_.read(body_.temporary(node));
  for (size_t i = 0; i < outputs.size(); ++i) {
    Value target = arguments[i + (with_mip ? 1 : 0)];
    if (!lower_.places.require_place(target, target.location, "an output of GetDimensions")) {
      return error_value();
    }
    // The stride of a structured buffer is its type's, whatever view is bound. [DXC]
    const bool is_stride = has_elements(type->resource) && outputs[i] == 1;
    const ir::Expr* number =
        is_stride ? build_.uint32(layout_of(type->element, ir::Layout::kStructured).size)
                  : build_.swizzle(all, {outputs[i]});
    const Value value = rvalue(number, types_.scalar(Scalar::kUint32));
    lower_.places.store(target, lower_.conversions.convert(value, target.type, target.location));
  }
  return rvalue(build_.int32(0), types_.void_type());
}

const ir::Expr* Textures::from_texel(const ir::Expr* raw, const Type* type) {
  if (!has_paired_texel(type)) return raw;
  const ir::Expr* halves = build_.read(body_.temporary(raw));
  std::vector<const ir::Expr*> parts;
  for (uint8_t i = 0; i < type->components(); ++i) {
    const auto half = [&](int which) {
      const ir::Expr* part = build_.swizzle(halves, {static_cast<uint8_t>(2 * i + which)});
      return build_.convert(part, Scalar::kUint32);
    };
    if (type->scalar == Scalar::kFloat64) {
      parts.push_back(build_.intrinsic(Intrinsic::asdouble, build_.scalar_type(Scalar::kFloat64),
                                       {half(0), half(1)}));
      continue;
    }
    const ir::Type* wide = build_.scalar_type(Scalar::kUint64);
    const ir::Expr* high =
        build_.binary(ir::BinaryOp::kShiftLeft, build_.convert(half(1), Scalar::kUint64),
                      build_.literal(wide, {32}));
    const ir::Expr* bits =
        build_.binary(ir::BinaryOp::kBitOr, high, build_.convert(half(0), Scalar::kUint64));
    parts.push_back(build_.convert(bits, type->ir->scalar));
  }
  return parts.size() == 1 ? parts[0] : build_.construct(type->ir, std::move(parts));
}

const ir::Expr* Textures::to_texel(const ir::Expr* value, const Type* type) {
  if (!has_paired_texel(type)) return value;
  const ir::Expr* whole = build_.read(body_.temporary(value));
  const Type* texel_type = types_.texel_of(type);
  std::vector<const ir::Expr*> parts;
  for (uint8_t i = 0; i < type->components(); ++i) {
    const ir::Expr* part = type->is_vector() ? build_.swizzle(whole, {i}) : whole;
    const ir::Type* half = build_.scalar_type(Scalar::kUint32);
    const ir::Expr* halves[2];
    if (type->scalar == Scalar::kFloat64) {
      halves[0] = build_.intrinsic(Intrinsic::asuint_low, half, {part});
      halves[1] = build_.intrinsic(Intrinsic::asuint_high, half, {part});
    } else {
      const ir::Type* wide = build_.scalar_type(Scalar::kUint64);
      const ir::Expr* bits = build_.convert(part, Scalar::kUint64);
      halves[0] = build_.convert(bits, Scalar::kUint32);
      halves[1] =
          build_.convert(build_.binary(ir::BinaryOp::kShiftRight, bits, build_.literal(wide, {32})),
                         Scalar::kUint32);
    }
    for (const ir::Expr* one : halves) parts.push_back(build_.convert(one, texel_type->ir->scalar));
  }
  return build_.construct(texel_type->ir, std::move(parts));
}

}  // namespace kaamos::hlsl
