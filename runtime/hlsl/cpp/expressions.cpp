// SPDX-License-Identifier: MIT
//
// Expressions. Scalars of 32 and 64 bits use C++'s own operators where they mean the same (emitted
// code is compiled with -fwrapv); everything else goes through the prelude's functions.
#include <bit>
#include <cmath>
#include <cstdio>

#include "kaamos/shader/debugging.h"
#include "kaamos/shader/reordering.h"
#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/cpp/emitter.h"
#include "runtime/hlsl/ir/operators.h"
#include "runtime/hlsl/ir/texture_shape.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

// The kind of descriptor that it needs, as two arguments.
std::string descriptor_words(ResourceKind kind) {
  const ResourceClass c = class_of(kind);
  return "ks::DescriptorKind(" + std::to_string(static_cast<int>(c.kind)) +
         "), ks::DescriptorAccess(" + std::to_string(static_cast<int>(c.access)) + ")";
}

// C++ promotes smaller operands to int, and half is a class.
bool has_native_operators(const Type* type) {
  return type->kind == TypeKind::kScalar &&
         (type->scalar == Scalar::kInt32 || type->scalar == Scalar::kUint32 ||
          type->scalar == Scalar::kInt64 || type->scalar == Scalar::kUint64 ||
          type->scalar == Scalar::kFloat32 || type->scalar == Scalar::kFloat64);
}

std::string float_text(double number, const char* format, const char* suffix, const char* infinity,
                       uint64_t bits, const char* nan_type) {
  if (std::isinf(number)) {
    return std::string(number < 0 ? "(-" : "(") + infinity + ")";
  }
  if (std::isnan(number)) {
    return std::string("std::bit_cast<") + nan_type + ">(" + std::to_string(bits) +
           (nan_type[0] == 'd' ? "ull)" : "u)");
  }
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  std::string out = text;
  if (out.find_first_of(".eE") == std::string::npos) {
    out += ".0";
  }
  out += suffix;
  return number < 0 || std::signbit(number) ? "(" + out + ")" : out;
}

template <typename T>
std::string integer_text(T number, const char* suffix) {
  const std::string text = std::to_string(number) + suffix;
  return number < 0 ? "(" + text + ")" : text;
}

// A vector variable, or a vector field of one: there is nothing to evaluate.
bool is_vector_in_place(const Expr& expr) {
  if (expr.type->kind != TypeKind::kVector) return false;
  const Expr* place = &expr;
  while (place->kind == ExprKind::kField) place = place->operands[0];
  return place->kind == ExprKind::kVariable;
}

bool all_scalar(const std::vector<const Expr*>& operands) {
  for (const Expr* operand : operands) {
    if (operand->type->kind != TypeKind::kScalar) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::string component_list(const std::vector<uint8_t>& components) {
  std::string out;
  for (size_t i = 0; i < components.size(); ++i) {
    out += (i == 0 ? "" : ", ") + std::to_string(components[i]);
  }
  return out;
}

std::string CppEmitter::scalar_literal(Scalar scalar, uint64_t bits) {
  switch (scalar) {
    case Scalar::kBool:
      return bits != 0 ? "true" : "false";
    case Scalar::kInt16:
      return "int16_t(" + std::to_string(static_cast<int16_t>(bits)) + ")";
    case Scalar::kUint16:
      return "uint16_t(" + std::to_string(static_cast<uint16_t>(bits)) + ")";
    case Scalar::kInt32:
      return static_cast<uint32_t>(bits) == 0x80000000u
                 ? "int32_t(0x80000000u)"
                 : integer_text(static_cast<int32_t>(bits), "");
    case Scalar::kUint32:
      return integer_text(static_cast<uint32_t>(bits), "u");
    case Scalar::kInt64:
      return bits == 0x8000000000000000ull
                 ? "int64_t(0x8000000000000000ull)"
                 : "int64_t(" + std::to_string(static_cast<int64_t>(bits)) + ")";
    case Scalar::kUint64:
      return "uint64_t(" + std::to_string(bits) + "ull)";
    case Scalar::kFloat16: {
      const double number = std::bit_cast<double>(bits);
      return "ks::convert<ks::half>(" +
             scalar_literal(Scalar::kFloat32, std::bit_cast<uint64_t>(number)) + ")";
    }
    case Scalar::kFloat32: {
      const auto number = static_cast<float>(std::bit_cast<double>(bits));
      return float_text(static_cast<double>(number), "%.9g", "f", "__builtin_inff()",
                        std::bit_cast<uint32_t>(number), "float");
    }
    case Scalar::kFloat64:
      return float_text(std::bit_cast<double>(bits), "%.17g", "", "__builtin_inf()", bits,
                        "double");
    default:  // Only plain ones get here.
      break;
  }
  return "0";
}

std::string CppEmitter::literal(const Expr& expr) {
  if (expr.type->kind == TypeKind::kScalar) {
    return scalar_literal(expr.type->scalar, expr.literal.empty() ? 0 : expr.literal[0]);
  }
  std::string out = type(expr.type) + "{";
  for (size_t i = 0; i < expr.literal.size(); ++i) {
    out += (i == 0 ? "" : ", ") + scalar_literal(expr.type->scalar, expr.literal[i]);
  }
  return out + "}";
}

std::string CppEmitter::call(std::string_view function, const std::vector<const Expr*>& arguments) {
  std::string out(function);
  out += '(';
  for (size_t i = 0; i < arguments.size(); ++i) {
    out += i == 0 ? "" : ", ";
    out += value(arguments[i]);
  }
  return out + ')';
}

std::string CppEmitter::variable(const Variable* variable) {
  const std::string& name = variable_names_[variable];
  switch (variable->storage) {
    case Storage::kLocal:
    case Storage::kParameter:
      return name;
    case Storage::kStaticGlobal:
      return "ctx.statics." + name;
    case Storage::kConstant:
      return "u::" + name;
    case Storage::kGroupShared:
      return "ctx.shared->" + name;
  }
  return name;
}

std::string CppEmitter::construct(const Expr& expr) {
  const Type* t = expr.type;
  if (t->kind == TypeKind::kVector && !all_scalar(expr.operands)) {
    return call("ks::make<" + type(t) + ">", expr.operands);
  }
  if (t->kind == TypeKind::kMatrix) {
    return call("ks::make<" + type(t) + ">", expr.operands);
  }
  if (t->kind == TypeKind::kScalar) {
    return value(expr.operands[0]);
  }
  std::string out = type(t) + "{";
  for (size_t i = 0; i < expr.operands.size(); ++i) {
    out += (i == 0 ? "" : ", ") + value(expr.operands[i]);
  }
  return out + "}";
}

std::string CppEmitter::unary(const Expr& expr) {
  const bool native = has_native_operators(expr.type);
  const std::string operand = value(expr.operands[0]);
  switch (expr.unary) {
    case UnaryOp::kNegate:
      return native ? "(-" + operand + ")" : "ks::negate(" + operand + ")";
    case UnaryOp::kNot:
      return expr.type->kind == TypeKind::kScalar ? "(!" + operand + ")"
                                                  : "ks::logical_not(" + operand + ")";
    case UnaryOp::kBitNot:
      return native ? "(~" + operand + ")" : "ks::bit_not(" + operand + ")";
  }
  return operand;
}

std::string CppEmitter::binary(const Expr& expr) {
  const Type* operand_type = expr.operands[0]->type;
  const BinarySpelling& spelling = spelling_of(expr.binary);
  const bool divides = expr.binary == BinaryOp::kDivide && is_floating(operand_type->scalar);
  if ((spelling.is_native || divides) && has_native_operators(operand_type)) {
    return "(" + value(expr.operands[0]) + " " + spelling.symbol + " " + value(expr.operands[1]) +
           ")";
  }
  return call(spelling.cpp, expr.operands);
}

std::string CppEmitter::element(const Expr& expr, bool as_place) {
  const Expr* index = expr.operands[1];
  const Type* indexed = expr.operands[0]->type;
  const std::string base = as_place ? place(expr.operands[0]) : value(expr.operands[0]);
  const uint32_t count = indexed->kind == TypeKind::kArray    ? indexed->count
                         : indexed->kind == TypeKind::kMatrix ? indexed->rows
                                                              : indexed->columns;
  if (indexed->kind == TypeKind::kScalar) {
    return base;  // a vector with one component
  }
  if (index->kind == ExprKind::kLiteral && index->literal[0] < count) {
    return base + "[" + std::to_string(index->literal[0]) + "]" + behind_row(indexed);
  }
  return std::string(as_place ? "ks::element_ref(" : "ks::element(") + base + ", " + value(index) +
         ")" + behind_row(indexed);
}

std::string CppEmitter::system_value(const Expr& expr) {
  switch (expr.system_value) {
    case SystemValue::kDispatchRaysIndex:
      return "ks::dispatch_rays_index(ctx.invocation)";
    case SystemValue::kDispatchRaysDimensions:
      return "ks::dispatch_rays_dimensions(ctx.invocation)";
    case SystemValue::kWorldRayOrigin:
      return "ks::world_ray_origin(ctx.invocation)";
    case SystemValue::kWorldRayDirection:
      return "ks::world_ray_direction(ctx.invocation)";
    case SystemValue::kRayTMin:
      return "ctx.invocation.ray->ray.t_min";
    case SystemValue::kRayTCurrent:
      return "ctx.invocation.ray->t_current";
    case SystemValue::kRayFlags:
      return "ctx.invocation.ray->ray_flags";
    case SystemValue::kInstanceIndex:
      return "ctx.invocation.ray->instance_index";
    case SystemValue::kInstanceId:
      return "ctx.invocation.ray->instance_id";
    case SystemValue::kGeometryIndex:
      return "ctx.invocation.ray->geometry_index";
    case SystemValue::kPrimitiveIndex:
      return "ctx.invocation.ray->primitive_index";
    case SystemValue::kObjectRayOrigin:
      return "ks::object_ray_origin(ctx.invocation)";
    case SystemValue::kObjectRayDirection:
      return "ks::object_ray_direction(ctx.invocation)";
    case SystemValue::kObjectToWorld3x4:
      return "ks::object_to_world_3x4(ctx.invocation)";
    case SystemValue::kObjectToWorld4x3:
      return "ks::object_to_world_4x3(ctx.invocation)";
    case SystemValue::kWorldToObject3x4:
      return "ks::world_to_object_3x4(ctx.invocation)";
    case SystemValue::kWorldToObject4x3:
      return "ks::world_to_object_4x3(ctx.invocation)";
    case SystemValue::kHitKind:
      return "ctx.invocation.ray->hit_kind";
    case SystemValue::kPositionTable:
      return "ks::position_table(ctx.invocation.ray->world_to_object)";
  }
  return "0u";
}

std::string CppEmitter::binding(const Expr& expr) {
  const std::string index = expr.operands.empty() ? "0u" : value(expr.operands[0]);
  if (module_.check_access) {
    return "ks::checked::resource(ctx.invocation, " + site(expr.location) + ", " +
           std::to_string(expr.index) + "u, " + index + ")";
  }
  if (is_bound(expr)) return bound(expr) + ".descriptor";
  if (reads_bound_ && !expr.operands.empty()) {
    return "ks::bound_array_element(ctx.invocation, " + std::to_string(expr.index) + "u, " + index +
           ")";
  }
  if (reads_bound_) {
    const auto found = resources_found_.find(expr.index);
    if (found != resources_found_.end()) return found->second;
    return "ks::bound_resource(ctx.invocation, " + std::to_string(expr.index) + "u)";
  }
  return "ks::resource(ctx.invocation, " + std::to_string(expr.index) + "u, " + index + ")";
}

// Looked up by the group. This is only for compute shaders, whose functions no ray shader calls.
bool CppEmitter::is_bound(const Expr& expr) const {
  return binds_per_group_ && expr.kind == ExprKind::kBinding &&
         (expr.operands.empty() || bound_elements_[expr.index] != 0);
}

std::string CppEmitter::bound(const Expr& expr) {
  if (expr.operands.empty()) return "ctx.bound[" + std::to_string(expr.index) + "]";
  return "ks::bound_element<" + std::to_string(module_.bindings[expr.index].count) +
         "u>(ctx.bound + " + std::to_string(bound_elements_[expr.index]) + "u, " +
         value(expr.operands[0]) + ")";
}

std::string CppEmitter::texture(const Expr* expr) {
  if (is_bound(*expr)) return bound(*expr);
  if (reads_bound_ && expr->kind == ExprKind::kBinding && expr->operands.empty()) {
    return "ks::bound_texture(ctx.invocation, " + std::to_string(expr->index) + "u)";
  }
  return value(expr);
}

std::string CppEmitter::texel_coordinates_text(const Type* resource, const std::string& coordinates,
                                               const std::string& mip, const std::string& offset) {
  const bool array1d = resource->resource == ResourceKind::kTexture1DArray ||
                       resource->resource == ResourceKind::kRWTexture1DArray;
  return (array1d ? "ks::texel_coordinates_1d_array(" : "ks::texel_coordinates(") + coordinates +
         ", " + mip + (offset.empty() ? "" : ", ") + offset + ")";
}

std::string CppEmitter::texel_coordinates(const Type* resource, const Expr* coordinates,
                                          const Expr* mip, const Expr* offset) {
  return texel_coordinates_text(resource, value(coordinates),
                                mip != nullptr ? "int32_t(" + value(mip) + ")" : "0",
                                offset != nullptr ? value(offset) : "");
}

std::string CppEmitter::typed_load(const Expr& expr) {
  const Type* resource = expr.operands[0]->type;
  const std::string result = "<" + type(expr.type) + ">";
  if (resource->resource == ResourceKind::kBuffer ||
      resource->resource == ResourceKind::kRWBuffer) {
    return "ks::load_typed" + result + "(ctx.invocation, " + value(expr.operands[0]) +
           ", uint32_t(" + value(expr.operands[1]) + "))";
  }
  const Expr* mip = expr.operands.size() > 2 ? expr.operands[2] : nullptr;
  const Expr* offset = expr.operands.size() > 3 ? expr.operands[3] : nullptr;
  return "ks::load_texel" + result + "(ctx.invocation, " + texture(expr.operands[0]) + ", " +
         texel_coordinates(resource, expr.operands[1], mip, offset) + ")";
}

std::string CppEmitter::sample_text(const Expr& expr, const TextOf& text) {
  const auto& operands = expr.operands;
  const auto operand = [&](size_t i) { return text(operands[i]); };
  const char* function = "";
  std::string parameters;
  size_t fixed = 3;
  switch (expr.sample) {
    case SampleKind::kLevel:
      function = "sample_level";
      parameters = operand(3);
      fixed = 4;
      break;
    case SampleKind::kGradient:
      function = "sample_gradient";
      parameters = operand(3) + ", " + operand(4);
      fixed = 5;
      break;
    case SampleKind::kCompareLevel:
      function = "sample_compare_level";
      parameters = operand(3) + ", " + operand(4);
      fixed = 5;
      break;
    case SampleKind::kLevelOfDetail:
      return "ks::level_of_detail(ctx.invocation, " + operand(0) + ", " + operand(1) + ", " +
             operand(2) + ", " + operand(3) + ", " + operand(4) + ")";
    case SampleKind::kGather:
      function = "gather";
      parameters = std::to_string(expr.index) + "u";
      break;
    case SampleKind::kGatherCompare:
      function = "gather_compare";
      parameters = operand(3);
      fixed = 4;
      break;
  }
  std::string out = std::string("ks::") + function + "<" + type(expr.type) + ">(ctx.invocation, " +
                    operand(0) + ", " + operand(1) + ", " + operand(2) + ", " + parameters;
  if (operands.size() > fixed) {
    out += ", " + operand(fixed);
  }
  return out + ")";
}

std::string CppEmitter::value(const Expr* e) {
  const Expr& expr = *e;
  switch (expr.kind) {
    case ExprKind::kLiteral:
      return literal(expr);
    case ExprKind::kZero:
      return type(expr.type) + "{}";
    case ExprKind::kVariable:
      return variable(expr.variable);
    case ExprKind::kField:
      return value(expr.operands[0]) + "." +
             field_names_[expr.operands[0]->type->structure][expr.index];
    case ExprKind::kElement:
      return element(expr, false);
    case ExprKind::kSwizzle:
      return "ks::swizzle<" + component_list(expr.components) + ">(" + value(expr.operands[0]) +
             ")";
    case ExprKind::kMatrixSwizzle:
      return "ks::matrix_swizzle<" + component_list(expr.components) + ">(" +
             value(expr.operands[0]) + ")";
    case ExprKind::kConvert:
      return call(std::string("ks::convert<") + scalar_name(expr.type->scalar) + ">",
                  expr.operands);
    case ExprKind::kSplat:
      return call("ks::splat<" + type(expr.type) + ">", expr.operands);
    case ExprKind::kTruncate:
      return call("ks::truncate<" + type(expr.type) + ">", expr.operands);
    case ExprKind::kConstruct:
      return construct(expr);
    case ExprKind::kUnary:
      return unary(expr);
    case ExprKind::kBinary:
      return binary(expr);
    case ExprKind::kSelect:
      return call("ks::select", expr.operands);
    case ExprKind::kConditional:
      if (is_vector_in_place(*expr.operands[1]) && is_vector_in_place(*expr.operands[2])) {
        return call("ks::select", expr.operands);
      }
      return "(" + value(expr.operands[0]) + " ? " + value(expr.operands[1]) + " : " +
             value(expr.operands[2]) + ")";
    case ExprKind::kLogicalAnd:
      return "(" + value(expr.operands[0]) + " && " + value(expr.operands[1]) + ")";
    case ExprKind::kLogicalOr:
      return "(" + value(expr.operands[0]) + " || " + value(expr.operands[1]) + ")";
    case ExprKind::kIntrinsic:
      return call("ks::" + std::string(name_of(expr.intrinsic)), expr.operands);
    case ExprKind::kSystemValue:
      return system_value(expr);
    case ExprKind::kQueryValue:
      return query_value(expr);
    case ExprKind::kBinding:
      return binding(expr);
    case ExprKind::kPrintBuffer:
      return "ctx.invocation.dispatch->prints";
    case ExprKind::kHeapResource: {
      if (module_.check_access) {
        return "ks::checked::heap_resource(ctx.invocation, " + site(expr.location) + ", " +
               value(expr.operands[0]) + ", " + descriptor_words(expr.type->resource) + ", " +
               std::to_string(texture_shape(*expr.type)) + "u)";
      }
      if (const uint32_t shape = texture_shape(*expr.type)) {
        return "ks::heap_texture(ctx.invocation, " + value(expr.operands[0]) + ", " +
               std::to_string(shape) + "u)";
      }
      const bool sampler = expr.type->resource == ResourceKind::kSampler ||
                           expr.type->resource == ResourceKind::kSamplerComparison;
      return "ks::heap_resource(ctx.invocation, " + value(expr.operands[0]) +
             (sampler ? ", true)" : ", false)");
    }
    case ExprKind::kLoad:
    case ExprKind::kLoadElement:
      return load(expr);
    case ExprKind::kTypedLoad:
      return typed_load(expr);
    case ExprKind::kSample:
      return sample_text(expr, [this](const Expr* operand) { return value(operand); });
    case ExprKind::kDimensions:
      return "ks::dimensions(ctx.invocation, " + value(expr.operands[0]) + ", " +
             (expr.operands.size() > 1 ? "uint32_t(" + value(expr.operands[1]) + ")" : "0u") + ")";
    case ExprKind::kSameBytes:
      return call("ks::same_bytes<" + type(expr.type) + ">", expr.operands);
    case ExprKind::kRecordConstant:
      if (is_literal(expr.operands[1], shader::kDebuggingEnabled)) {
        return "ks::is_debugging_enabled(ctx.invocation)";
      }
      if (!module_.check_access && is_literal(expr.operands[1], shader::kReorderedRecord)) {
        return "0u";
      }
      return "ks::record_constant(ctx.invocation, " + value(expr.operands[0]) + ", " +
             value(expr.operands[1]) + ")";
    case ExprKind::kTrianglePositions:
      return std::string(module_.check_access ? "ks::checked::triangle_positions(ctx.invocation, " +
                                                    site(expr.location) + ", "
                                              : "ks::triangle_positions(") +
             value(expr.operands[0]) + ", " + value(expr.operands[1]) + ", " +
             value(expr.operands[2]) + ")";
    case ExprKind::kClusterId:
      return call("ks::cluster_id", expr.operands);
    case ExprKind::kQuad:  // a statement by now
      break;
  }
  return "";
}

std::string CppEmitter::place(const Expr* e) {
  const Expr& expr = *e;
  switch (expr.kind) {
    case ExprKind::kVariable:
      return variable(expr.variable);
    case ExprKind::kField:
      return place(expr.operands[0]) + "." +
             field_names_[expr.operands[0]->type->structure][expr.index];
    case ExprKind::kElement:
      return element(expr, true);
    case ExprKind::kSwizzle:
      // One component of a vector, or of a scalar, which is the scalar itself.
      return expr.operands[0]->type->kind == TypeKind::kScalar
                 ? place(expr.operands[0])
                 : place(expr.operands[0]) + "[" + std::to_string(expr.components[0]) + "]";
    case ExprKind::kMatrixSwizzle:
      return place(expr.operands[0]) + "[" + std::to_string(expr.components[0] / 4) + "][" +
             std::to_string(expr.components[0] % 4) + "]";
    default:
      return value(e);
  }
}

}  // namespace kaamos::hlsl
