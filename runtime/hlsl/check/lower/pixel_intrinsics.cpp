// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/pixel_intrinsics.h"

#include <algorithm>
#include <utility>

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

// Targets have one sample, at the centre of the pixel, which is where an input has its value.
Value PixelIntrinsics::evaluate_attribute(std::string_view name, std::vector<Value>& arguments,
                                          SourceLocation location) {
  const size_t count = name.ends_with("Sample") ? 2 : 1;
  if (!lower_.intrinsics.check_count(name, arguments.size(), count, count, location)) {
    return error_value();
  }
  lower_.intrinsics.use_in_stages(name, ir::kStagePixel, location);
  if (!lower_.intrinsics.is_short_argument(name, 0, arguments[0])) return error_value();
  const Type* type = type_of_numbers(name, arguments[0]);
  if (!type) return error_value();
  if (count == 2 && !lower_.conversions.convert(arguments[1], types_.scalar(Scalar::kUint32),
                                                arguments[1].location)) {
    return error_value();
  }
  return rvalue(lower_.conversions.convert(arguments[0], type, arguments[0].location), type);
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
    report(CheckId::kVertexAttribute, argument.location, {wanted});
    return error_value();
  };
  if (number->kind != ir::ExprKind::kLiteral || number->literal[0] > 2) {
    return refuse(arguments[1], "a constant 0, 1 or 2");
  }
  constexpr const char* kInput =
      "an input of the pixel shader itself, or a scalar or vector of one";
  if (arguments[0].kind != ValueKind::kExpr || type->is_matrix())
    return refuse(arguments[0], kInput);
  const ir::Expr* place = arguments[0].expr;
  const ir::Expr* swizzle = place->kind == ir::ExprKind::kSwizzle ? place : nullptr;
  if (swizzle) place = swizzle->operands[0];
  VertexRead read;
  const ir::Expr* of = place;
  for (;; of = of->operands[0]) {
    if (of->kind == ir::ExprKind::kField) {
      read.path.push_back(of->index);
    } else if (of->kind == ir::ExprKind::kElement &&
               of->operands[0]->type->kind == ir::TypeKind::kArray &&
               of->operands[1]->kind == ir::ExprKind::kLiteral) {
      read.path.push_back(static_cast<uint32_t>(of->operands[1]->literal[0]));
    } else {
      break;
    }
  }
  const bool is_input = of->kind == ir::ExprKind::kVariable && body_.function &&
                        of->variable->storage == ir::Storage::kParameter &&
                        of->variable->mode == ir::ParameterMode::kIn;
  if (!is_input) return refuse(arguments[0], kInput);
  std::reverse(read.path.begin(), read.path.end());
  read.parameter = of->variable;
  read.location = arguments[0].location;
  auto& reads = body_.function->vertex_reads;
  auto found = std::find_if(reads.begin(), reads.end(), [&](const VertexRead& other) {
    return other.parameter == read.parameter && other.path == read.path;
  });
  if (found == reads.end()) found = reads.insert(found, std::move(read));
  const ir::Expr* value = place;
  if (number->literal[0] != 0) {
    VariableInfo*& info = found->values[number->literal[0] - 1];
    if (!info) {
      info = names_.make_variable();
      info->kind = VariableKind::kGlobal;
      info->variable = build_.variable("at_vertex", place->type, ir::Storage::kStaticGlobal);
      body_.function->globals.push_back(info);
    }
    value = build_.read(info->variable);
  }
  if (swizzle) value = build_.swizzle(value, swizzle->components);
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
