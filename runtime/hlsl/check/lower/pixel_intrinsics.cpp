// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/pixel_intrinsics.h"

#include <algorithm>
#include <utility>

#include "kaamos/shader/sample_patterns.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {

using shader::WaveOp;

// Compute shaders have derivatives from Shader Model 6.6 on.
uint32_t PixelIntrinsics::stages_with_quads() const {
  const bool in_compute = shader_model_minor(names_.options().target) >= 6;
  return ir::kStagePixel | (in_compute ? uint32_t{ir::kStageCompute} : 0);
}

void PixelIntrinsics::use_derivative(std::string_view name, SourceLocation location) {
  if (!body_.function) return;
  body_.function->stage_uses.push_back(
      {.place = location.raw, .name = name, .stages = stages_with_quads(), .is_derivative = true});
}

const ir::Expr* PixelIntrinsics::quad_value(WaveOp op, const ir::Expr* operand) {
  ir::Expr* node = build_.expr(ir::ExprKind::kQuad, operand->type, {operand});
  node->wave = op;
  if (body_.function) body_.function->quads.push_back(node);
  return node;
}

// The type of the first argument; null after an error.
const Type* PixelIntrinsics::type_of_numbers(std::string_view name, const Value& argument) {
  const Type* type = argument.type;
  if (type && type->is_numeric()) return types_.settled(type);
  report(CheckId::kIntrinsicArgument, argument.location,
         {"1", std::string(name), "a number, a vector or a matrix",
          type ? to_string(type) : "a resource"});
  return nullptr;
}

Value PixelIntrinsics::call_pixel_function(std::string_view name, std::vector<Value>& arguments,
                                           SourceLocation location) {
  if (name == "IsHelperLane") return is_helper_lane(arguments, location);
  if (name == "GetAttributeAtVertex") return attribute_at_vertex(arguments, location);
  if (name.starts_with("GetRenderTargetSample")) {
    return render_target_sample(name, arguments, location);
  }
  if (name.starts_with("EvaluateAttribute")) return evaluate_attribute(name, arguments, location);
  if (!lower_.intrinsics.check_count(name, arguments.size(), 1, 1, location)) return error_value();
  if (name == "clip") {
    lower_.intrinsics.use_in_stages(name, ir::kStagePixel, location);
  } else {
    use_derivative(name, location);
  }
  const Type* type = type_of_numbers(name, arguments[0]);
  if (!type) return error_value();
  if (!is_floating(type->scalar) || type->scalar == Scalar::kFloat64) {
    type = types_.with_scalar(type, Scalar::kFloat32);
  }
  const ir::Expr* operand = lower_.conversions.convert(arguments[0], type, arguments[0].location);
  if (!operand) return error_value();
  at(location);
  operand = body_.repeatable(operand);
  std::vector<const ir::Expr*> rows;  // of a matrix
  for (uint8_t row = 0; row < type->rows; ++row) {
    std::vector<uint8_t> components;
    for (uint8_t column = 0; column < type->columns; ++column) {
      components.push_back(static_cast<uint8_t>(row * 4 + column));
    }
    rows.push_back(build_.matrix_swizzle(operand, components));
  }
  if (rows.empty()) rows.push_back(operand);
  if (name == "clip") {
    const ir::Expr* negative = nullptr;
    for (const ir::Expr* row : rows) {
      const ir::Expr* less = build_.binary(ir::BinaryOp::kLess, row, build_.zero(row->type));
      const ir::Type* flag = build_.scalar_type(Scalar::kBool);
      const ir::Expr* any = build_.intrinsic(Intrinsic::any, flag, {less});
      negative = negative ? build_.binary(ir::BinaryOp::kBitOr, negative, any) : any;
    }
    ir::Stmt* condition = build_.stmt(ir::StmtKind::kIf);
    condition->value = negative;
    condition->body.push_back(build_.stmt(ir::StmtKind::kDiscard));
    body_.emit(condition);
    return rvalue(build_.int32(0), types_.void_type());
  }
  const bool across = name.starts_with("ddx");
  const WaveOp op = name.ends_with("_fine") ? (across ? WaveOp::kDdxFine : WaveOp::kDdyFine)
                                            : (across ? WaveOp::kDdxCoarse : WaveOp::kDdyCoarse);
  for (const ir::Expr*& row : rows) {
    if (name != "fwidth") {
      row = quad_value(op, row);
      continue;
    }
    const auto length = [&](WaveOp which) {
      return build_.intrinsic(Intrinsic::abs, row->type, {quad_value(which, row)});
    };
    row = build_.binary(ir::BinaryOp::kAdd, length(WaveOp::kDdxCoarse), length(WaveOp::kDdyCoarse));
  }
  return rvalue(type->is_matrix() ? build_.construct(type->ir, rows) : rows[0], type);
}

// A static global that stays false, except in the functions of pixel shaders, where `live` takes
// its place.
Value PixelIntrinsics::is_helper_lane(std::vector<Value>& arguments, SourceLocation location) {
  if (!lower_.intrinsics.check_count("IsHelperLane", arguments.size(), 0, 0, location)) {
    return error_value();
  }
  ir::Variable*& variable = bench_.is_helper;
  if (!variable) {
    variable =
        build_.variable("is_helper", build_.scalar_type(Scalar::kBool), ir::Storage::kStaticGlobal);
  }
  return rvalue(build_.read(body_.temporary(build_.read(variable))), types_.boolean());
}

// A static global that the pixel shader fills.
const ir::Expr* PixelIntrinsics::sample_count() {
  VariableInfo*& info = bench_.sample_count;
  if (!info) {
    info = names_.make_variable();
    info->kind = VariableKind::kGlobal;
    info->variable = build_.variable("sample_count", build_.scalar_type(Scalar::kUint32),
                                     ir::Storage::kStaticGlobal);
  }
  if (body_.function) body_.function->globals.push_back(info);
  return body_.repeatable(build_.read(info->variable));
}

namespace {

// Four samples of a pattern from `first` on, a byte each, the lowest first: x and y in sixteenths
// of a pixel, and 8. Where the pattern has no more, the middle.
template <size_t kCount>
constexpr uint32_t packed(const shader::SampleOffset (&pattern)[kCount], size_t first) {
  uint32_t out = 0;
  for (size_t i = 0; i < 4; ++i) {
    const bool there = first + i < kCount;
    const int x = there ? pattern[first + i].x : 0, y = there ? pattern[first + i].y : 0;
    out |= static_cast<uint32_t>(x + 8 + (y + 8) * 16) << 8 * i;
  }
  return out;
}

}  // namespace

// Samples that the targets do not have are in the middle.
const ir::Expr* PixelIntrinsics::sample_position(const ir::Expr* number) {
  using Op = ir::BinaryOp;
  const ir::Expr* count = sample_count();
  number = body_.repeatable(number);
  const auto operation = [&](Op op, const ir::Expr* value, uint32_t constant) {
    return build_.binary(op, value, build_.uint32(constant));
  };
  const auto from = [&](size_t first) {
    const ir::Expr* out = build_.uint32(packed(shader::kOneSample, first));
    for (const auto& [samples, word] : {std::pair{2u, packed(shader::kTwoSamples, first)},
                                        {4u, packed(shader::kFourSamples, first)},
                                        {8u, packed(shader::kEightSamples, first)}}) {
      out = build_.conditional(operation(Op::kEqual, count, samples), build_.uint32(word), out);
    }
    return out;
  };
  const ir::Expr* beyond = build_.uint32(packed(shader::kOneSample, 0));
  const ir::Expr* high = build_.conditional(operation(Op::kLess, number, 8), from(4), beyond);
  const ir::Expr* word = build_.conditional(operation(Op::kLess, number, 4), from(0), high);
  const ir::Expr* shift = operation(Op::kMultiply, operation(Op::kBitAnd, number, 3), 8);
  const ir::Expr* both = body_.repeatable(build_.binary(Op::kShiftRight, word, shift));
  const auto coordinate = [&](uint32_t first_bit) {
    const ir::Expr* bits = operation(Op::kBitAnd, operation(Op::kShiftRight, both, first_bit), 15);
    const ir::Expr* whole = build_.binary(Op::kSubtract, build_.convert(bits, Scalar::kFloat32),
                                          build_.convert(build_.uint32(8), Scalar::kFloat32));
    return build_.binary(Op::kDivide, whole, build_.convert(build_.uint32(16), Scalar::kFloat32));
  };
  return build_.construct(build_.vector_type(Scalar::kFloat32, 2), {coordinate(0), coordinate(4)});
}

Value PixelIntrinsics::render_target_sample(std::string_view name, std::vector<Value>& arguments,
                                            SourceLocation location) {
  const bool position = name.ends_with("Position");
  const size_t count = position ? 1 : 0;
  if (!lower_.intrinsics.check_count(name, arguments.size(), count, count, location)) {
    return error_value();
  }
  lower_.intrinsics.use_in_stages(name, ir::kStagePixel, location);
  if (!position) return rvalue(sample_count(), types_.scalar(Scalar::kUint32));
  const ir::Expr* number = lower_.conversions.convert(arguments[0], types_.scalar(Scalar::kUint32),
                                                      arguments[0].location);
  if (!number) return error_value();
  at(location);
  return rvalue(sample_position(number), types_.vector(Scalar::kFloat32, 2));
}

PixelIntrinsics::InputPlace PixelIntrinsics::input_place(const Value& argument) {
  InputPlace out;
  if (argument.kind != ValueKind::kExpr) return out;
  const ir::Expr* place = argument.expr;
  out.swizzle = place->kind == ir::ExprKind::kSwizzle ? place : nullptr;
  if (out.swizzle) place = out.swizzle->operands[0];
  const ir::Expr* of = place;
  for (;; of = of->operands[0]) {
    if (of->kind == ir::ExprKind::kField) {
      out.read.path.push_back(of->index);
    } else if (of->kind == ir::ExprKind::kElement &&
               of->operands[0]->type->kind == ir::TypeKind::kArray &&
               of->operands[1]->kind == ir::ExprKind::kLiteral) {
      out.read.path.push_back(static_cast<uint32_t>(of->operands[1]->literal[0]));
    } else {
      break;
    }
  }
  const bool is_input = of->kind == ir::ExprKind::kVariable && body_.function &&
                        of->variable->storage == ir::Storage::kParameter &&
                        of->variable->mode == ir::ParameterMode::kIn;
  if (!is_input) return out;
  std::reverse(out.read.path.begin(), out.read.path.end());
  out.read.parameter = of->variable;
  out.read.location = argument.location;
  out.value = place;
  return out;
}

InputRead& PixelIntrinsics::known_read(const InputRead& read) {
  auto& reads = body_.function->input_reads;
  const auto found = std::find_if(reads.begin(), reads.end(), [&](const InputRead& other) {
    return other.parameter == read.parameter && other.path == read.path &&
           other.of_vertices == read.of_vertices;
  });
  return found == reads.end() ? reads.emplace_back(read) : *found;
}

const ir::Expr* PixelIntrinsics::fact_of(InputRead& read, InputFact fact, const ir::Type* type) {
  VariableInfo*& info = read.facts[static_cast<size_t>(fact)];
  if (!info) {
    info = names_.make_variable();
    info->kind = VariableKind::kGlobal;
    info->variable = build_.variable("of_input", type, ir::Storage::kStaticGlobal);
    body_.function->globals.push_back(info);
  }
  return build_.read(info->variable);
}

const ir::Expr* PixelIntrinsics::evaluated(const InputRead& place, const ir::Type* type,
                                           const ir::Expr* offset) {
  using Op = ir::BinaryOp;
  InputRead& read = known_read(place);
  if (!offset) return fact_of(read, InputFact::kCentroid, type);
  const auto spread = [&](const ir::Expr* value) {
    return type->kind == ir::TypeKind::kScalar ? value : build_.splat(value, type);
  };
  // Both the input over w and 1 / w are linear on the screen.
  const ir::Expr* w = fact_of(read, InputFact::kInverseW, build_.vector_type(Scalar::kFloat32, 3));
  const ir::Expr* x = build_.swizzle(offset, {0});
  const ir::Expr* y = build_.swizzle(offset, {1});
  const auto moved = [&](const ir::Expr* middle, const ir::Expr* slope_x, const ir::Expr* slope_y,
                         const auto& as_type) {
    return build_.binary(Op::kAdd, middle,
                         build_.binary(Op::kAdd, build_.binary(Op::kMultiply, slope_x, as_type(x)),
                                       build_.binary(Op::kMultiply, slope_y, as_type(y))));
  };
  const ir::Expr* middle = fact_of(read, InputFact::kMiddle, type);
  const ir::Expr* over_w = moved(
      build_.binary(Op::kMultiply, middle, spread(build_.swizzle(w, {0}))),
      fact_of(read, InputFact::kSlopeX, type), fact_of(read, InputFact::kSlopeY, type), spread);
  const ir::Expr* inverse_w = moved(build_.swizzle(w, {0}), build_.swizzle(w, {1}),
                                    build_.swizzle(w, {2}), [](const ir::Expr* v) { return v; });
  const ir::Expr* zero = build_.zero(x->type);
  const ir::Expr* in_middle = build_.binary(Op::kBitAnd, build_.binary(Op::kEqual, x, zero),
                                            build_.binary(Op::kEqual, y, zero));
  return build_.conditional(in_middle, middle,
                            build_.binary(Op::kDivide, over_w, spread(inverse_w)));
}

Value PixelIntrinsics::evaluate_attribute(std::string_view name, std::vector<Value>& arguments,
                                          SourceLocation location) {
  const bool centroid = name.ends_with("Centroid");
  const size_t count = centroid ? 1 : 2;
  if (!lower_.intrinsics.check_count(name, arguments.size(), count, count, location)) {
    return error_value();
  }
  lower_.intrinsics.use_in_stages(name, ir::kStagePixel, location);
  if (!lower_.intrinsics.is_short_argument(name, 0, arguments[0])) return error_value();
  const Type* type = type_of_numbers(name, arguments[0]);
  if (!type) return error_value();
  const ir::Expr* offset = nullptr;
  if (!centroid) {
    const bool snapped = name.ends_with("Snapped");
    const Type* wanted =
        snapped ? types_.vector(Scalar::kInt32, 2) : types_.scalar(Scalar::kUint32);
    const ir::Expr* where = lower_.conversions.convert(arguments[1], wanted, arguments[1].location);
    if (!where) return error_value();
    at(location);
    if (snapped) {
      const ir::Type* pair = build_.vector_type(Scalar::kFloat32, 2);
      const ir::Expr* sixteen = build_.convert(build_.uint32(16), Scalar::kFloat32);
      offset = build_.binary(ir::BinaryOp::kDivide, build_.convert(where, Scalar::kFloat32),
                             build_.splat(sixteen, pair));
    } else {
      offset = sample_position(where);
    }
    offset = body_.repeatable(offset);
  }
  const InputPlace place = input_place(arguments[0]);
  if (!place.value) {
    report(CheckId::kVertexAttribute, arguments[0].location,
           {std::string(name), "an input of the pixel shader itself"});
    return error_value();
  }
  // Integers are the same everywhere.
  if (!is_floating(type->scalar)) {
    return rvalue(lower_.conversions.convert(arguments[0], type, arguments[0].location), type);
  }
  if (!type->is_matrix()) {
    const ir::Expr* value = evaluated(place.read, place.value->type, offset);
    if (place.swizzle) value = build_.swizzle(value, place.swizzle->components);
    return rvalue(value, type);
  }
  // Row by row, or column by column, as it is passed.
  const uint8_t lines = type->row_major ? type->rows : type->columns;
  const uint8_t size = type->row_major ? type->columns : type->rows;
  const ir::Type* line_type =
      size == 1 ? build_.scalar_type(type->scalar) : build_.vector_type(type->scalar, size);
  std::vector<const ir::Expr*> components(size_t{type->rows} * type->columns);
  for (uint8_t line = 0; line < lines; ++line) {
    InputRead read = place.read;
    read.path.push_back(line);
    const ir::Expr* value = body_.repeatable(evaluated(read, line_type, offset));
    for (uint8_t i = 0; i < size; ++i) {
      const size_t at =
          type->row_major ? size_t{line} * type->columns + i : size_t{i} * type->columns + line;
      components[at] = size == 1 ? value : build_.swizzle(value, {i});
    }
  }
  return rvalue(build_.construct(type->ir, std::move(components)), type);
}

// The values of the other two vertices are inputs of their own, which the entry point's wrapper
// puts into static variables.
Value PixelIntrinsics::attribute_at_vertex(std::vector<Value>& arguments, SourceLocation location) {
  const std::string_view name = "GetAttributeAtVertex";
  if (!lower_.intrinsics.check_count(name, arguments.size(), 2, 2, location)) return error_value();
  lower_.intrinsics.use_in_stages(name, ir::kStagePixel, location);
  const Type* type = type_of_numbers(name, arguments[0]);
  const ir::Expr* number = lower_.conversions.convert(arguments[1], types_.scalar(Scalar::kUint32),
                                                      arguments[1].location);
  if (!type || !number) return error_value();
  const auto refuse = [&](const Value& argument, const char* wanted) {
    report(CheckId::kVertexAttribute, argument.location, {std::string(name), wanted});
    return error_value();
  };
  if (number->kind != ir::ExprKind::kLiteral || number->literal[0] > 2) {
    return refuse(arguments[1], "a constant 0, 1 or 2");
  }
  const InputPlace place = input_place(arguments[0]);
  if (!place.value || type->is_matrix()) {
    return refuse(arguments[0],
                  "an input of the pixel shader itself, or a scalar or vector of one");
  }
  const ir::Expr* value = place.value;
  InputRead wanted = place.read;
  wanted.of_vertices = true;
  InputRead& read = known_read(wanted);
  if (number->literal[0] != 0) {
    const bool second = number->literal[0] == 1;
    value = fact_of(read, second ? InputFact::kSecondVertex : InputFact::kThirdVertex, value->type);
  }
  if (place.swizzle) value = build_.swizzle(value, place.swizzle->components);
  return rvalue(value, type);
}

void PixelIntrinsics::use_implicit_level(std::string_view name, ir::Expr* sample,
                                         SourceLocation location) {
  sample->implicit_level = true;
  if (!body_.function) return;
  body_.function->stage_uses.push_back({.place = location.raw,
                                        .name = name,
                                        .stages = stages_with_quads(),
                                        .is_implicit_level = true});
  body_.function->implicit_levels.push_back(sample);
}

Value PixelIntrinsics::call_level_of_detail(const Value& object, bool clamped,
                                            std::vector<Value>& arguments,
                                            SourceLocation location) {
  const std::string_view name =
      clamped ? "CalculateLevelOfDetail" : "CalculateLevelOfDetailUnclamped";
  if (!lower_.intrinsics.check_count(name, arguments.size(), 2, 2, location)) return error_value();
  use_derivative(name, location);
  const ResourceTraits& traits = traits_of(object.type->resource);
  const uint32_t size = traits.coordinates - (traits.is_array ? 1u : 0u);
  const ir::Expr* resource = lower_.places.load(object);
  const bool compares = arguments[0].type && arguments[0].type->is_resource() &&
                        arguments[0].type->resource == ir::ResourceKind::kSamplerComparison;
  const auto kind = compares ? ir::ResourceKind::kSamplerComparison : ir::ResourceKind::kSampler;
  const ir::Expr* sampler = lower_.conversions.convert(arguments[0], types_.resource(kind, nullptr),
                                                       arguments[0].location);
  const ir::Expr* coordinates =
      lower_.resources.to_vector(arguments[1], Scalar::kFloat32, size, arguments[1].location);
  if (!resource || !sampler || !coordinates) return error_value();
  at(location);
  if (traits.is_array) {
    std::vector<const ir::Expr*> parts = {coordinates,
                                          build_.zero(build_.scalar_type(Scalar::kFloat32))};
    coordinates =
        build_.construct(build_.vector_type(Scalar::kFloat32, size + 1), std::move(parts));
  }
  const Type* type = types_.scalar(Scalar::kFloat32);
  ir::Expr* level = build_.expr(ir::ExprKind::kSample, type->ir, {resource, sampler, coordinates});
  level->sample = ir::SampleKind::kLevelOfDetail;
  level->implicit_level = true;
  if (body_.function) body_.function->implicit_levels.push_back(level);
  if (!clamped) return rvalue(level, type);
  const ir::Expr* sizes =
      build_.expr(ir::ExprKind::kDimensions, build_.vector_type(Scalar::kUint32, 4),
                  {resource, build_.uint32(0)});
  const ir::Expr* mips = build_.convert(build_.swizzle(sizes, {3}), Scalar::kFloat32);
  const ir::Expr* last = build_.binary(ir::BinaryOp::kSubtract, mips,
                                       build_.convert(build_.uint32(1), Scalar::kFloat32));
  const ir::Expr* lowest = build_.zero(type->ir);
  return rvalue(build_.intrinsic(Intrinsic::clamp, type->ir, {level, lowest, last}), type);
}

}  // namespace kaamos::hlsl
