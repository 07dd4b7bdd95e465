// SPDX-License-Identifier: MIT
#include "runtime/hlsl/builder/finish/lone_lane.h"

#include <utility>

namespace kaamos::hlsl {
namespace {

using shader::WaveOp;

// Returns what the operation gives in a wave of one lane.
const ir::Expr* value_in_lone_lane(IrBuilder& build, const ir::Stmt& wave) {
  const ir::Type* type = wave.result->type;
  const ir::Expr* value = wave.operands.empty() ? nullptr : wave.operands[0];
  const auto first_of_four = [&](const ir::Expr* first) {
    const ir::Expr* zero = build.uint32(0);
    return build.construct(type, {first, zero, zero, zero});
  };
  const auto filled = [&](const ir::Expr* one) {
    return type->kind == ir::TypeKind::kScalar ? one : build.splat(one, type);
  };
  switch (wave.wave) {
    case WaveOp::kLaneCount:
      return build.uint32(1);
    case WaveOp::kIsFirstLane:
      return build.boolean(true);
    case WaveOp::kAllEqual:
      return filled(build.boolean(true));
    case WaveOp::kCountBits:
      return build.convert(value, Scalar::kUint32);
    case WaveOp::kBallot:
      return first_of_four(build.convert(value, Scalar::kUint32));
    case WaveOp::kMatch:
      return first_of_four(build.uint32(1));
    case WaveOp::kPrefixProduct:
    case WaveOp::kMultiPrefixProduct:
      return filled(build.convert(build.uint32(1), type->scalar));
    case WaveOp::kMultiPrefixBitAnd:
      return build.unary(ir::UnaryOp::kBitNot, build.zero(type));
    case WaveOp::kLaneIndex:
    case WaveOp::kPrefixCountBits:
    case WaveOp::kPrefixSum:
    case WaveOp::kMultiPrefixSum:
    case WaveOp::kMultiPrefixCountBits:
    case WaveOp::kMultiPrefixBitOr:
    case WaveOp::kMultiPrefixBitXor:
      return build.zero(type);
    default:
      return value;
  }
}

}  // namespace

void make_wave_lone(IrBuilder& build, ir::Stmt& wave) {
  build.location = wave.location;
  wave.value = value_in_lone_lane(build, wave);
  wave.place = build.read(wave.result);
  wave.kind = ir::StmtKind::kAssign;
  wave.result = nullptr;
  wave.operands.clear();
}

void take_level_zero(IrBuilder& build, FunctionFacts& function) {
  for (ir::Expr* sample : function.implicit_levels) {
    if (!sample->implicit_level) continue;
    sample->implicit_level = false;
    const ir::Expr* least = build.zero(build.scalar_type(Scalar::kFloat32));
    if (std::exchange(sample->clamps_level, false)) {
      least = sample->operands.back();
      sample->operands.pop_back();
    }
    if (sample->sample == ir::SampleKind::kLevel) sample->operands[3] = least;
    if (sample->sample == ir::SampleKind::kCompareLevel) sample->operands[4] = least;
  }
}

}  // namespace kaamos::hlsl
