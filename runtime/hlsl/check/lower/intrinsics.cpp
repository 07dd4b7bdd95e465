// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/intrinsics.h"

#include <algorithm>

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_functions.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {
namespace {

bool is_number(const Value& value) {
  return value.type && (value.type->is_numeric() ||
                        (value.type->is_enum() && !value.type->enumeration->is_class));
}

bool is_everywhere_two(const ir::Expr& expr) {
  if (expr.kind == ir::ExprKind::kSplat) return is_everywhere_two(*expr.operands[0]);
  if (expr.kind != ir::ExprKind::kLiteral) return false;
  const uint64_t two = convert_bits(2, Scalar::kInt32, expr.type->scalar);
  return std::all_of(expr.literal.begin(), expr.literal.end(),
                     [&](uint64_t bits) { return bits == two; });
}

// Arguments from here on have a type of their own; the others get one in common.
size_t joined_arguments(const IntrinsicRule& rule) {
  return rule.shape == IntrinsicShape::kRefract ? 2 : rule.count;
}

bool takes_floats_only(IntrinsicShape shape) {
  using S = IntrinsicShape;
  return shape == S::kFloat || shape == S::kTest || shape == S::kLength || shape == S::kDistance ||
         shape == S::kVector || shape == S::kRefract || shape == S::kCross ||
         shape == S::kDeterminant || shape == S::kDst || shape == S::kLit ||
         shape == S::kFloatToHalf;
}

// Functions of directions and the like, which are not for long vectors. [HLSL: 0026 Long vectors,
// Disallowed vector intrinsics]
bool takes_short_vectors_only(IntrinsicShape shape) {
  using S = IntrinsicShape;
  return shape == S::kLength || shape == S::kDistance || shape == S::kVector ||
         shape == S::kRefract || shape == S::kCross || shape == S::kDst || shape == S::kLit ||
         shape == S::kMsad4;
}

bool takes_vectors_only(IntrinsicShape shape) {
  using S = IntrinsicShape;
  return shape == S::kLength || shape == S::kDistance || shape == S::kVector ||
         shape == S::kRefract || shape == S::kDot;
}

// Returns how many arguments a function of numbers takes that has no IntrinsicRule; 0: it is none.
size_t other_arguments(std::string_view name) {
  if (name == "mul" || name == "and" || name == "or" || name == "modf" || name == "frexp") return 2;
  if (name == "select" || name == "sincos") return 3;
  return 0;
}

}  // namespace

std::optional<ConversionCost> Intrinsics::cost_of_builtin(std::string_view name,
                                                          const std::vector<Value>& arguments) {
  if (!std::all_of(arguments.begin(), arguments.end(), is_number)) return std::nullopt;
  if (const size_t count = other_arguments(name); count != 0) {
    return arguments.size() == count ? std::optional<ConversionCost>(0) : std::nullopt;
  }
  const IntrinsicRule* rule = find_intrinsic(name);
  if (!rule || arguments.size() != rule->count || rule->count == 0) return std::nullopt;
  const Type* type = arguments[0].type;
  for (size_t i = 1; type && i < joined_arguments(*rule); ++i) {
    bool truncates = false;
    type = lower_.operators.find_joined_type(type, arguments[i].type, truncates);
  }
  if (!type) return std::nullopt;
  if (takes_floats_only(rule->shape) && (type->is_enum() || !is_floating(type->scalar))) {
    type = type->is_enum() ? types_.scalar(Scalar::kFloat32)
                           : types_.with_scalar(type, Scalar::kFloat32);
  }
  ConversionCost cost = 0;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const Type* to = i < joined_arguments(*rule) ? type : types_.scalar(type->scalar);
    const ConversionRank rank = lower_.conversions.rank(arguments[i], to);
    if (!rank.possible) return std::nullopt;
    cost += rank.cost;
  }
  return cost;
}

bool Intrinsics::check_count(std::string_view name, size_t given, size_t lowest, size_t highest,
                             SourceLocation location) {
  if (given >= lowest && given <= highest) return true;
  const std::string allowed = lowest == highest
                                  ? std::to_string(lowest)
                                  : std::to_string(lowest) + " to " + std::to_string(highest);
  report(CheckId::kArgumentCount, location, {std::string(name), allowed, std::to_string(given)});
  return false;
}

void Intrinsics::use_in_stages(std::string_view name, uint32_t stages, SourceLocation location,
                               bool is_lenient) {
  if (!body_.function) return;
  const bool known =
      std::any_of(body_.function->stage_uses.begin(), body_.function->stage_uses.end(),
                  [&](const StageUse& use) { return use.name == name; });
  if (known) return;
  body_.function->stage_uses.push_back(
      {.place = location.raw, .name = name, .stages = stages, .is_lenient = is_lenient});
}

std::optional<Value> Intrinsics::call_builtin(const NamePart& part, std::vector<Value>& arguments,
                                              SourceLocation location) {
  const std::string_view name = part.identifier;
  const size_t count = arguments.size();
  at(location);
  lower_.body_rules.check_model(name, location);
  if (name == "mul") return call_mul(arguments, location);
  if (lower_.packed_numbers.is_packed_intrinsic(name))
    return lower_.packed_numbers.call_packed(name, arguments, location);
  if (name == "select") return call_select(arguments, location);
  if (name == "and" || name == "or") return call_and_or(name == "and", arguments, location);
  if (name == "sincos" || name == "modf" || name == "frexp" || (name == "asuint" && count == 3)) {
    return call_with_outputs(name, arguments, location);
  }
  if (const IntrinsicRule* rule = find_intrinsic(name)) {
    if (!check_count(name, count, rule->count, rule->count, location)) return error_value();
    return call_maths(*rule, arguments, location);
  }
  if (const SystemValueRule* rule = find_system_value(name)) {
    if (!check_count(name, count, 0, 0, location)) return error_value();
    return lower_.ray_intrinsics.call_system_value(*rule, location);
  }
  if (name == "NonUniformResourceIndex") {
    if (!check_count(name, count, 1, 1, location)) return error_value();
    const Type* type = types_.scalar(Scalar::kUint32);
    const ir::Expr* index = lower_.elements.index_value(arguments[0], location);
    return rvalue(index ? build_.convert(index, Scalar::kUint32) : nullptr, type);
  }
  if (name == "CheckAccessFullyMapped") {
    if (!check_count(name, count, 1, 1, location)) return error_value();
    const ir::Expr* status =
        lower_.conversions.convert(arguments[0], types_.scalar(Scalar::kUint32), location);
    return rvalue(status ? build_.convert(status, Scalar::kBool) : nullptr, types_.boolean());
  }
  if (name == "D3DCOLORtoUBYTE4") {
    if (!check_count(name, count, 1, 1, location)) return error_value();
    if (!is_short_argument(name, 0, arguments[0])) return error_value();
    const Type* type = types_.vector(Scalar::kFloat32, 4);
    const ir::Expr* value = lower_.conversions.convert(arguments[0], type, location);
    if (!value) return error_value();
    const ir::Expr* scale =
        build_.splat(build_.literal(types_.scalar(Scalar::kFloat32)->ir,
                                    {normalise_bits(float_bits(255.001953), Scalar::kFloat32)}),
                     type->ir);
    const ir::Expr* scaled =
        build_.binary(ir::BinaryOp::kMultiply, build_.swizzle(value, {2, 1, 0, 3}), scale);
    return rvalue(build_.convert(scaled, Scalar::kInt32), types_.vector(Scalar::kInt32, 4));
  }
  if (auto value = lower_.triangle_positions.call_function(name, arguments, location)) {
    return *value;
  }
  if (name == "DebugBreak") return lower_.debugging.call_break(arguments, location);
  if (name == "TraceRay") return lower_.ray_intrinsics.call_trace_ray(arguments, location);
  if (name == "ReportHit") return lower_.ray_intrinsics.call_report_hit(arguments, location);
  if (name == "CallShader") return lower_.ray_intrinsics.call_call_shader(arguments, location);
  if (name == "IgnoreHit" || name == "AcceptHitAndEndSearch") {
    if (!check_count(name, count, 0, 0, location)) return error_value();
    use_in_stages(name, ir::kStageAnyHit, location);
    if (body_.function) body_.function->ends_shader = true;
    body_.emit(build_.stmt(name == "IgnoreHit" ? ir::StmtKind::kIgnoreHit
                                               : ir::StmtKind::kAcceptHitAndEndSearch));
    return rvalue(build_.int32(0), types_.void_type());
  }
  if (const BarrierRule* rule = find_barrier(name)) {
    if (!check_count(name, count, 0, 0, location)) return error_value();
    const bool group = rule->flags & (ir::kGroupMemory | ir::kGroupSync);
    if (group) use_in_stages(name, ir::kStageCompute, location, name == "AllMemoryBarrier");
    return emit_barrier(rule->flags);
  }
  if (name == "Barrier") return call_barrier(arguments, location);
  if (is_pixel_function(name))
    return lower_.pixel_intrinsics.call_pixel_function(name, arguments, location);
  if (const AtomicRule* rule = find_atomic(name); rule && rule->name == name) {
    if (name != "InterlockedExchangeFloat")
      return lower_.atomics.call_interlocked(*rule, arguments, location);
  }
  if (const auto wave = lower_.waves.call_wave(name, arguments, location)) return wave;
  const std::string_view family = unsupported_function(name);
  if (!family.empty()) {
    report(CheckId::kUnsupported, location,
           {"'" + std::string(name) + "' (" + std::string(family) + ")"});
    return error_value();
  }
  return std::nullopt;
}

bool Intrinsics::is_short_argument(std::string_view name, size_t index, const Value& argument) {
  if (!argument.type || !argument.type->is_long_vector()) return true;
  report(CheckId::kLongVectorArgument, argument.location,
         {std::to_string(index + 1), std::string(name), to_string(argument.type)});
  return false;
}

Value Intrinsics::emit_barrier(uint32_t flags) {
  if (body_.function && (flags & ir::kGroupSync)) body_.function->has_barrier = true;
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kBarrier);
  statement->barrier = flags;
  body_.emit(statement);
  return rvalue(build_.int32(0), types_.void_type());
}

// Barrier(memory types, semantics) and Barrier(resource, semantics). [HLSL: Barrier]
Value Intrinsics::call_barrier(std::vector<Value>& arguments, SourceLocation location) {
  if (!check_count("Barrier", arguments.size(), 2, 2, location)) return error_value();
  uint32_t given[2] = {kUavMemory, 0};
  constexpr const char* kWhat[] = {"memory types", "semantics"};
  const Type* first = arguments[0].type;
  const bool of_resource = first && first->is_resource();
  if (of_resource && !traits_of(first->resource).is_writable) {
    report(CheckId::kBarrierFlags, arguments[0].location,
           {kWhat[0], "a " + to_string(first), "only resources that are written have barriers"});
    return error_value();
  }
  for (size_t i = of_resource ? 1 : 0; i < 2; ++i) {
    const ir::Expr* value = lower_.conversions.convert(arguments[i], types_.scalar(Scalar::kUint32),
                                                       arguments[i].location);
    if (!value) return error_value();
    const auto bits = evaluate(value);
    if (!bits) {
      report(CheckId::kBarrierFlags, arguments[i].location,
             {kWhat[i], "not constant", "they must be"});
      return error_value();
    }
    given[i] = static_cast<uint32_t>((*bits)[0]);
    if (given[i] > 0xF) {
      report(CheckId::kBarrierFlags, arguments[i].location,
             {kWhat[i], std::to_string(given[i]), "the largest is 15"});
      return error_value();
    }
  }
  const auto [memory, semantics] = given;
  const bool reorders = (semantics & kReorderScope) != 0;
  if (reorders && (memory != kUavMemory || (semantics & kGroupSyncSemantic) != 0)) {
    report(CheckId::kBarrierFlags, location,
           {"semantics", std::to_string(semantics),
            "REORDER_SCOPE goes with UAV_MEMORY alone, and not with GROUP_SYNC"});
    return error_value();
  }
  constexpr uint32_t kRayStages = ir::kStageRayGeneration | ir::kStageIntersection |
                                  ir::kStageAnyHit | ir::kStageClosestHit | ir::kStageMiss |
                                  ir::kStageCallable;
  if (reorders) use_in_stages("REORDER_SCOPE", kRayStages, location);
  const bool group = memory != 0xF && (memory & kGroupSharedMemory) != 0;
  if (group || (semantics & (kGroupSyncSemantic | kGroupScope)) != 0) {
    use_in_stages("Barrier of a thread group", ir::kStageCompute, location);
  }
  return emit_barrier(((memory & kUavMemory) != 0 ? ir::kDeviceMemory : 0u) |
                      ((memory & kGroupSharedMemory) != 0 ? ir::kGroupMemory : 0u) |
                      ((semantics & kGroupSyncSemantic) != 0 ? ir::kGroupSync : 0u));
}

Value Intrinsics::call_maths(const IntrinsicRule& rule, std::vector<Value>& arguments,
                             SourceLocation location) {
  using S = IntrinsicShape;
  const S shape = rule.shape;
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (!is_number(arguments[i])) {
      report(CheckId::kIntrinsicArgument, arguments[i].location,
             {std::to_string(i + 1), std::string(rule.name), "a number",
              arguments[i].type ? to_string(arguments[i].type) : "a resource"});
      return error_value();
    }
  }
  for (size_t i = 0; takes_short_vectors_only(shape) && i < arguments.size(); ++i) {
    if (!is_short_argument(rule.name, i, arguments[i])) return error_value();
  }
  const size_t joined = joined_arguments(rule);
  const Type* type =
      arguments[0].type->is_enum() ? types_.scalar(Scalar::kInt32) : arguments[0].type;
  for (size_t i = 1; i < joined; ++i) {
    bool truncates = false;
    const Type* next = lower_.operators.find_joined_type(type, arguments[i].type, truncates);
    if (!next) {
      report(CheckId::kNoCommonType, location, {to_string(type), to_string(arguments[i].type)});
      return error_value();
    }
    if (truncates) {
      const bool first = type->components() > next->components();
      report(CheckId::kTruncation, location,
             {to_string(first ? type : arguments[i].type), to_string(next)});
    }
    const bool mixes = (type->is_vector() && arguments[i].type->is_matrix()) ||
                       (type->is_matrix() && arguments[i].type->is_vector());
    if (mixes) {
      report(CheckId::kMixedShapes, location,
             {std::string(rule.name), to_string(type), to_string(arguments[i].type)});
      // Functions of vectors take the matrix for one.
      if (takes_vectors_only(shape)) next = types_.vector(next->scalar, next->components());
    }
    type = next;
  }
  const bool matrix_operation = shape == S::kTranspose || shape == S::kDeterminant;
  if (takes_floats_only(shape) && (!is_floating(type->scalar) || is_literal(type->scalar))) {
    type = types_.with_scalar(type, Scalar::kFloat32);
  }
  if (is_literal(type->scalar)) {
    const bool big = arguments.size() == 1 &&
                     lower_.conversions.settle(arguments[0]).type->scalar == Scalar::kUint32;
    type = big ? types_.with_scalar(type, Scalar::kUint32) : types_.settled(type);
  }
  if (shape == S::kNumeric || shape == S::kSign || shape == S::kDot) {
    if (type->scalar == Scalar::kBool) type = types_.with_scalar(type, Scalar::kInt32);
  }
  const auto refuse = [&](size_t index, std::string_view expected) {
    report(CheckId::kIntrinsicArgument, arguments[index].location,
           {std::to_string(index + 1), std::string(rule.name), std::string(expected),
            to_string(arguments[index].type)});
    return error_value();
  };
  const bool scalars_only = shape == S::kLit || shape == S::kRefract;
  for (size_t i = shape == S::kLit ? 0 : joined; scalars_only && i < arguments.size(); ++i) {
    if (arguments[i].type->components() == 1 || arguments[i].type->is_enum()) continue;
    report(CheckId::kScalarArgument, arguments[i].location,
           {std::to_string(i + 1), std::string(rule.name), to_string(arguments[i].type)});
  }
  if (takes_vectors_only(shape) && type->is_matrix()) return refuse(0, "a vector");
  if (matrix_operation && type->is_vector()) return refuse(0, "a matrix");
  if (matrix_operation && !type->is_matrix()) {
    // A scalar is a matrix of one element.
    const Type* result =
        shape == S::kTranspose ? types_.matrix(type->scalar, 1, 1) : types_.scalar(type->scalar);
    return rvalue(lower_.conversions.convert(arguments[0], result, location), result);
  }
  const Type* result = type;
  switch (shape) {
    case S::kUint:
      if (is_floating(type->scalar)) return refuse(0, "an integer");
      if (type->scalar == Scalar::kBool) type = types_.with_scalar(type, Scalar::kUint32);
      result = types_.with_scalar(type, Scalar::kUint32);
      if (rule.intrinsic == Intrinsic::reversebits) result = type;
      if (rule.intrinsic == Intrinsic::countbits &&
          scalar_bytes(type->scalar, ScalarStorage::kBuffer) == 4) {
        type = result;
      }
      break;
    case S::kSign:
      result = types_.with_scalar(type, Scalar::kInt32);
      break;
    case S::kTest:
      result = types_.with_scalar(type, Scalar::kBool);
      break;
    case S::kReduce:
      type = types_.with_scalar(type, Scalar::kBool);
      result = types_.boolean();
      if (type->is_scalar())
        return rvalue(lower_.conversions.convert(arguments[0], type, location), result);
      break;
    case S::kDot:
    case S::kLength:
    case S::kDistance:
      result = types_.scalar(type->scalar);
      break;
    case S::kCross:
      if (!type->is_vector() || type->columns < 3) return refuse(0, "a vector of 3");
      type = result = types_.vector(type->scalar, 3);
      break;
    case S::kTranspose:
      result = types_.matrix(type->scalar, type->columns, type->rows);
      break;
    case S::kDeterminant:
      if (type->rows != type->columns) return refuse(0, "a square matrix");
      result = types_.scalar(type->scalar);
      break;
    case S::kAsFloat:
    case S::kAsInt:
    case S::kAsUint: {
      const Scalar plain = plain_scalar(type->scalar);
      const bool fits =
          plain == Scalar::kInt32 || plain == Scalar::kUint32 || plain == Scalar::kFloat32;
      if (!fits) return refuse(0, "components of 32 bits (int, uint or float)");
      result = types_.with_scalar(type, shape == S::kAsFloat ? Scalar::kFloat32
                                        : shape == S::kAsInt ? Scalar::kInt32
                                                             : Scalar::kUint32);
      if (type->ir == result->ir)
        return rvalue(lower_.conversions.convert(arguments[0], type, location), result);
      break;
    }
    case S::kAsFloat16:
    case S::kAsInt16:
    case S::kAsUint16:
      if (scalar_bytes(type->scalar, ScalarStorage::kBuffer) != 2)
        return refuse(0, "components of 16 bits");
      result = types_.with_scalar(type, shape == S::kAsFloat16 ? Scalar::kFloat16
                                        : shape == S::kAsInt16 ? Scalar::kInt16
                                                               : Scalar::kUint16);
      if (same_type(type, result))
        return rvalue(lower_.conversions.convert(arguments[0], type, location), type);
      break;
    case S::kHalfToFloat:
      type = types_.with_scalar(type, Scalar::kUint32);
      result = types_.with_scalar(type, Scalar::kFloat32);
      break;
    case S::kFloatToHalf:
      type = types_.with_scalar(type, Scalar::kFloat32);
      result = types_.with_scalar(type, Scalar::kUint32);
      break;
    case S::kDouble:
      type = result = types_.with_scalar(type, Scalar::kFloat64);
      break;
    case S::kAsDouble:
      type = types_.with_scalar(type, Scalar::kUint32);
      if (type->is_matrix()) return refuse(0, "a scalar or a vector");
      result = types_.with_scalar(type, Scalar::kFloat64);
      break;
    case S::kDst:
      type = result = types_.vector(type->scalar, 4);
      break;
    case S::kLit:
      type = types_.scalar(type->scalar);
      result = types_.vector(type->scalar, 4);
      break;
    default:
      break;
  }
  std::vector<const ir::Expr*> operands;
  if (shape == S::kMsad4) {
    const Type* uint_type = types_.scalar(Scalar::kUint32);
    const Type* types[] = {uint_type, types_.vector(Scalar::kUint32, 2),
                           types_.vector(Scalar::kUint32, 4)};
    for (size_t i = 0; i < 3; ++i) {
      operands.push_back(lower_.conversions.convert(arguments[i], types[i], arguments[i].location));
    }
    result = types[2];
  } else {
    for (size_t i = 0; i < arguments.size(); ++i) {
      const Type* to = i < joined ? type : types_.scalar(type->scalar);
      const ir::Expr* expr = lower_.places.load(arguments[i]);
      if (!expr) return error_value();
      const Type* from = arguments[i].type->is_enum() ? types_.scalar(arguments[i].type->scalar)
                                                      : arguments[i].type;
      if (!lower_.conversions.convertible_numeric(from, to)) return refuse(i, to_string(to));
      operands.push_back(lower_.conversions.convert_numeric(expr, from, to));
    }
  }
  for (const ir::Expr* operand : operands) {
    if (!operand) return error_value();
  }
  at(location);
  // As in DXC, which makes a product of a square only: it is defined for numbers below zero.
  if (rule.intrinsic == Intrinsic::pow && is_everywhere_two(*operands[1])) {
    const ir::Expr* base = body_.repeatable(operands[0]);
    return rvalue(build_.binary(ir::BinaryOp::kMultiply, base, base), result);
  }
  if (type->is_scalar()) {
    // Vector functions on scalars reduce to arithmetic.
    const auto absolute = [&](const ir::Expr* value) {
      return build_.intrinsic(Intrinsic::abs, type->ir, {value});
    };
    if (shape == S::kDot) {
      return rvalue(build_.binary(ir::BinaryOp::kMultiply, operands[0], operands[1]), result);
    }
    if (shape == S::kLength) return rvalue(absolute(operands[0]), result);
    if (shape == S::kDistance) {
      return rvalue(absolute(build_.binary(ir::BinaryOp::kSubtract, operands[0], operands[1])),
                    result);
    }
    if (rule.intrinsic == Intrinsic::normalize) {
      const ir::Expr* value = body_.repeatable(operands[0]);
      return rvalue(build_.binary(ir::BinaryOp::kDivide, value, absolute(value)), result);
    }
  }
  return rvalue(build_.intrinsic(rule.intrinsic, result->ir, std::move(operands)), result);
}

Value Intrinsics::call_mul(std::vector<Value>& arguments, SourceLocation location) {
  if (!check_count("mul", arguments.size(), 2, 2, location)) return error_value();
  for (size_t i = 0; i < 2; ++i) {
    if (!is_number(arguments[i])) {
      report(CheckId::kIntrinsicArgument, arguments[i].location,
             {std::to_string(i + 1), "mul", "a number, a vector or a matrix",
              arguments[i].type ? to_string(arguments[i].type) : "a resource"});
      return error_value();
    }
  }
  const Type* a = arguments[0].type;
  const Type* b = arguments[1].type;
  const auto scalar_of = [](const Type* type) {
    return type->is_enum() ? Scalar::kInt32 : type->scalar;
  };
  Scalar scalar = combined_scalar(scalar_of(a), scalar_of(b));
  if (scalar == Scalar::kBool || scalar == Scalar::kLiteralInt) scalar = Scalar::kInt32;
  if (scalar == Scalar::kLiteralFloat) scalar = Scalar::kFloat32;
  const auto single = [](const Type* type) { return type->is_scalar() || type->is_enum(); };
  if (single(a) || single(b)) {
    const Type* type = types_.with_scalar(single(a) ? b : a, scalar);
    const ir::Expr* left = lower_.conversions.convert(arguments[0], type, arguments[0].location);
    const ir::Expr* right = lower_.conversions.convert(arguments[1], type, arguments[1].location);
    if (!left || !right) return error_value();
    return rvalue(build_.binary(ir::BinaryOp::kMultiply, left, right), type);
  }
  // A vector on the left is a row, on the right a column.
  const uint32_t inner_a = a->columns;
  const uint32_t inner_b = b->is_matrix() ? b->rows : b->columns;
  const uint32_t inner = std::min(inner_a, inner_b);
  if (inner_a != inner_b) {
    report(CheckId::kMulShape, location, {to_string(a), to_string(b), std::to_string(inner)});
  }
  const Type* left_type =
      a->is_matrix() ? types_.matrix(scalar, a->rows, inner) : types_.vector(scalar, inner);
  const Type* right_type =
      b->is_matrix() ? types_.matrix(scalar, inner, b->columns) : types_.vector(scalar, inner);
  const Type* result = a->is_matrix() && b->is_matrix() ? types_.matrix(scalar, a->rows, b->columns)
                       : a->is_matrix()                 ? types_.vector(scalar, a->rows)
                       : b->is_matrix()                 ? types_.vector(scalar, b->columns)
                                                        : types_.scalar(scalar);
  const ir::Expr* left =
      lower_.conversions.convert(arguments[0], left_type, arguments[0].location, true);
  const ir::Expr* right =
      lower_.conversions.convert(arguments[1], right_type, arguments[1].location, true);
  if (!left || !right) return error_value();
  at(location);
  const bool vectors = a->is_vector() && b->is_vector();
  return rvalue(
      build_.intrinsic(vectors ? Intrinsic::dot : Intrinsic::mul, result->ir, {left, right}),
      result);
}

Value Intrinsics::call_select(std::vector<Value>& arguments, SourceLocation location) {
  if (!check_count("select", arguments.size(), 3, 3, location)) return error_value();
  Value& condition = arguments[0];
  if (!is_number(condition)) {
    report(CheckId::kConditionType, location,
           {condition.type ? to_string(condition.type) : "a resource"});
    return error_value();
  }
  const Type* type = nullptr;
  if (is_number(arguments[1]) && is_number(arguments[2])) {
    bool truncates = false;
    type = lower_.operators.common_type(arguments[1].type, arguments[2].type, location, truncates);
    if (!type) return error_value();
    type = types_.settled(type);
    if (!condition.type->is_scalar() && type->is_scalar()) {
      type = types_.with_scalar(condition.type, type->scalar);
    }
    if (!condition.type->is_scalar() && type->components() != condition.type->components()) {
      report(CheckId::kNoCommonType, location, {to_string(condition.type), to_string(type)});
      return error_value();
    }
  } else if (arguments[1].type && arguments[2].type &&
             same_type(arguments[1].type, arguments[2].type) && condition.type->is_scalar()) {
    return select_whole(arguments, location);
  } else {
    report(CheckId::kNoCommonType, location,
           {arguments[1].type ? to_string(arguments[1].type) : "a resource",
            arguments[2].type ? to_string(arguments[2].type) : "a resource"});
    return error_value();
  }
  const Type* boolean = condition.type->is_enum()
                            ? types_.boolean()
                            : types_.with_scalar(condition.type, Scalar::kBool);
  const ir::Expr* test = lower_.conversions.convert(condition, boolean, condition.location);
  const ir::Expr* yes = lower_.conversions.convert(arguments[1], type, arguments[1].location, true);
  const ir::Expr* no = lower_.conversions.convert(arguments[2], type, arguments[2].location, true);
  if (!test || !yes || !no) return error_value();
  at(location);
  return rvalue(build_.expr(ir::ExprKind::kSelect, type->ir, {test, yes, no}), type);
}

// Samplers, and what DXC leaves to ?: and if.
Value Intrinsics::select_whole(const std::vector<Value>& arguments, SourceLocation location) {
  const Type* type = arguments[1].type;
  if (!type->is_resource() || !is_sampler(type->resource)) {
    report(CheckId::kSelectOfStructs, location, {to_string(type)});
  }
  const ir::Expr* test =
      lower_.conversions.convert(arguments[0], types_.boolean(), arguments[0].location);
  const ir::Expr* yes = lower_.places.load(arguments[1]);
  const ir::Expr* no = lower_.places.load(arguments[2]);
  if (!test || !yes || !no) return error_value();
  at(location);
  return rvalue(build_.conditional(test, yes, no), type);
}

Value Intrinsics::call_and_or(bool is_and, std::vector<Value>& arguments, SourceLocation location) {
  if (!check_count(is_and ? "and" : "or", arguments.size(), 2, 2, location)) return error_value();
  return lower_.operators.binary_value(is_and ? BinaryOp::kLogicalAnd : BinaryOp::kLogicalOr,
                                       arguments[0], arguments[1], location);
}

Value Intrinsics::call_with_outputs(std::string_view name, std::vector<Value>& arguments,
                                    SourceLocation location) {
  const size_t count = name == "sincos" || name == "asuint" ? 3 : 2;
  if (!check_count(name, arguments.size(), count, count, location)) return error_value();
  if (!is_number(arguments[0])) {
    report(CheckId::kIntrinsicArgument, arguments[0].location,
           {"1", std::string(name), "a number",
            arguments[0].type ? to_string(arguments[0].type) : "a resource"});
    return error_value();
  }
  for (size_t i = 1; i < count; ++i) {
    if (!lower_.places.require_place(arguments[i], arguments[i].location,
                                     "an output of '" + std::string(name) + "'")) {
      return error_value();
    }
  }
  const bool is_double = name == "asuint";
  Scalar scalar = arguments[0].type->scalar;
  if (is_double) {
    scalar = Scalar::kFloat64;
  } else if (!is_floating(scalar) || is_literal(scalar)) {
    scalar = Scalar::kFloat32;
  }
  const Type* type = types_.with_scalar(
      arguments[0].type->is_enum() ? types_.scalar(scalar) : arguments[0].type, scalar);
  const ir::Expr* input = lower_.conversions.convert(arguments[0], type, location);
  if (!input) return error_value();
  const ir::Expr* x = build_.read(body_.temporary(input));
  const auto put = [&](size_t index, Intrinsic part, const Type* part_type) {
    const Value value = rvalue(build_.intrinsic(part, part_type->ir, {x}), part_type);
    Value target = arguments[index];
    size_t position = body_.block->size();
    lower_.places.freeze(target, &position);
    lower_.places.store(target, lower_.conversions.convert(value, target.type, location, false));
  };
  const Type* void_type = types_.void_type();
  if (name == "sincos") {
    put(1, Intrinsic::sin, type);
    put(2, Intrinsic::cos, type);
    return rvalue(build_.int32(0), void_type);
  }
  if (name == "asuint") {
    const Type* part = types_.with_scalar(type, Scalar::kUint32);
    put(1, Intrinsic::asuint_low, part);
    put(2, Intrinsic::asuint_high, part);
    return rvalue(build_.int32(0), void_type);
  }
  const bool is_modf = name == "modf";
  put(1, is_modf ? Intrinsic::modf_integer : Intrinsic::frexp_exponent, type);
  at(location);
  return rvalue(build_.intrinsic(is_modf ? Intrinsic::modf_fraction : Intrinsic::frexp_mantissa,
                                 type->ir, {x}),
                type);
}

}  // namespace kaamos::hlsl
