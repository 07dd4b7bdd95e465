// SPDX-License-Identifier: MIT
// Wave intrinsics in ray tracing shaders. Each thread is a wave of its own, which DXR allows: waves
// may be re-formed at every trace and call. [DXR: Wave intrinsics] [HLSL: Shader Model 6.0]
#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {
namespace {

enum class WaveResult : uint8_t {
  kOne,        // uint 1
  kZero,       // uint 0
  kTrue,       // bool
  kCondition,  // the argument as bool
  kCount,      // the argument as bool, then as uint
  kBallot,     // the same in the first of four components
  kMatch,      // uint4 with this lane's bit
  kAllEqual,   // bool with the argument's shape
  kArgument,   // the argument
  kInteger,    // the argument, which is an integer
  kNothing,    // zero, of the argument's type
  kNeutral,    // one, of the argument's type
};

struct WaveRule {
  std::string_view name;
  uint8_t arguments;
  WaveResult result;
};

using R = WaveResult;
constexpr WaveRule kWaveRules[] = {
    {"WaveGetLaneCount", 0, R::kOne},
    {"WaveGetLaneIndex", 0, R::kZero},
    {"WaveIsFirstLane", 0, R::kTrue},
    {"WaveActiveAnyTrue", 1, R::kCondition},
    {"WaveActiveAllTrue", 1, R::kCondition},
    {"WaveActiveCountBits", 1, R::kCount},
    {"WavePrefixCountBits", 1, R::kZero},
    {"WaveActiveBallot", 1, R::kBallot},
    {"WaveMatch", 1, R::kMatch},
    {"WaveActiveAllEqual", 1, R::kAllEqual},
    {"WaveReadLaneFirst", 1, R::kArgument},
    {"WaveReadLaneAt", 2, R::kArgument},
    {"WaveActiveSum", 1, R::kArgument},
    {"WaveActiveProduct", 1, R::kArgument},
    {"WaveActiveMin", 1, R::kArgument},
    {"WaveActiveMax", 1, R::kArgument},
    {"WaveActiveBitAnd", 1, R::kInteger},
    {"WaveActiveBitOr", 1, R::kInteger},
    {"WaveActiveBitXor", 1, R::kInteger},
    {"WavePrefixSum", 1, R::kNothing},
    {"WavePrefixProduct", 1, R::kNeutral},
};

const WaveRule* find_wave(std::string_view name) {
  for (const WaveRule& rule : kWaveRules) {
    if (rule.name == name) return &rule;
  }
  return nullptr;
}

constexpr uint32_t kRayStages = ir::kStageRayGeneration | ir::kStageIntersection |
                                ir::kStageAnyHit | ir::kStageClosestHit | ir::kStageMiss |
                                ir::kStageCallable;

}  // namespace

std::optional<Value> Lowerer::call_wave(std::string_view name, std::vector<Value>& arguments,
                                        SourceLocation location) {
  const WaveRule* rule = find_wave(name);
  if (!rule) return std::nullopt;
  if (!check_count(name, arguments.size(), rule->arguments, rule->arguments, location)) {
    return error_value();
  }
  use_in_stages(name, kRayStages, location);
  for (size_t i = 0; i < arguments.size(); ++i) {
    const Type* type = arguments[i].type;
    if (type && type->is_numeric() && !type->is_matrix()) continue;
    report(CheckId::kIntrinsicArgument, arguments[i].location,
           {std::to_string(i + 1), std::string(name), "a number or a vector",
            type ? to_string(type) : "a resource"});
    return error_value();
  }
  const Type* unsigned_type = types_.scalar(Scalar::kUint32);
  const Type* type = unsigned_type;
  if (!arguments.empty()) {
    type = is_literal(arguments[0].type->scalar) ? settled(arguments[0].type) : arguments[0].type;
  }
  const auto condition = [&] { return convert(arguments[0], types_.boolean(), location); };
  const auto first_of_four = [&](const ir::Expr* first) {
    const Type* four = types_.vector(Scalar::kUint32, 4);
    const ir::Expr* zero = build_.uint32(0);
    return rvalue(first ? build_.construct(four->ir, {first, zero, zero, zero}) : nullptr, four);
  };
  const auto count = [&]() -> const ir::Expr* {
    const ir::Expr* value = condition();
    return value ? build_.convert(value, ir::Scalar::kUint32) : nullptr;
  };
  switch (rule->result) {
    case R::kOne:
      return rvalue(build_.uint32(1), unsigned_type);
    case R::kZero:
      return rvalue(build_.uint32(0), unsigned_type);
    case R::kTrue:
      return rvalue(build_.boolean(true), types_.boolean());
    case R::kCondition:
      return rvalue(condition(), types_.boolean());
    case R::kCount:
      return rvalue(count(), unsigned_type);
    case R::kBallot:
      return first_of_four(count());
    case R::kMatch:
      return first_of_four(build_.uint32(1));
    case R::kAllEqual: {
      const Type* result = types_.with_scalar(type, Scalar::kBool);
      const ir::Expr* yes = build_.boolean(true);
      return rvalue(result->is_scalar() ? yes : build_.splat(yes, result->ir), result);
    }
    case R::kInteger:
      if (is_floating(type->scalar)) {
        report(CheckId::kIntrinsicArgument, arguments[0].location,
               {"1", std::string(name), "an integer", to_string(type)});
        return error_value();
      }
      break;
    case R::kNothing:
      return rvalue(build_.zero(type->ir), type);
    case R::kNeutral: {
      const ir::Expr* one = build_.convert(build_.uint32(1), ir_scalar(type->scalar));
      return rvalue(type->is_scalar() ? one : build_.splat(one, type->ir), type);
    }
    case R::kArgument:
      break;
  }
  return rvalue(convert(arguments[0], type, location), type);
}

}  // namespace kaamos::hlsl
