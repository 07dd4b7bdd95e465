// SPDX-License-Identifier: MIT
//
// Wave operations, and the paths that say which lanes take part. [wave_paths.h]
#include <kaamos/shader/wave_results.h>

#include "runtime/hlsl/interpret/evaluate.h"
#include "runtime/hlsl/interpret/kernels.h"

namespace kaamos::hlsl::interpret {

using shader::WaveOp;

namespace {

// A ray shader has no group: its wave is one lane.
void run_lone(const shader::WaveCall& call) {
  if (call.op == WaveOp::kLaneCount || call.op == WaveOp::kLaneIndex) {
    *static_cast<uint32_t*>(call.result) = call.op == WaveOp::kLaneCount ? 1 : 0;
    return;
  }
  const uint32_t own = 0;
  with_scalar(scalar_of(call.scalar), [&](auto scalar) {
    using T = typename decltype(scalar)::type;
    shader::wave_results<T>(call.op,
                            {1, 1, call.components, static_cast<const T*>(call.value),
                             shader::has_lane_operand(call.op) ? &own : call.second, call.result});
  });
}

}  // namespace

void enter_path(const Action& action, Context& context) {
  if (action.place_in_wave != nullptr) {
    context.path[context.path_depth + action.place_in_wave->depth] = action.place_in_wave->number;
  }
}

uint32_t* iteration_in_path(const Action& loop, Context& context) {
  if (loop.place_in_wave == nullptr) return nullptr;
  enter_path(loop, context);
  uint32_t* const iteration = context.path + context.path_depth + loop.place_in_wave->depth + 1;
  *iteration = 0;
  return iteration;
}

void run_wave(const Action& action, Frame& frame) {
  Context& context = *frame.context;
  enter_path(action, context);
  shader::WaveCall call;
  call.op = action.stmt->wave;
  if (!action.operands.empty()) {
    const ir::Type* type = action.operands[0]->expr->type;
    call.scalar = wave_scalar(type->scalar);
    call.components = static_cast<uint8_t>(component_count(type));
    call.value = evaluate(*action.operands[0], frame);
  }
  if (action.operands.size() > 1) {
    call.second = reinterpret_cast<const uint32_t*>(evaluate(*action.operands[1], frame));
  }
  call.result = action.result->locate(*action.result, frame);
  call.path = context.path;
  call.path_length = context.path_depth + action.place_in_wave->depth + 1;
  const shader::Services& services = *context.invocation->dispatch->services;
  if (context.group != nullptr) return services.wave(*context.group, call);
  run_lone(call);
}

}  // namespace kaamos::hlsl::interpret
