// SPDX-License-Identifier: MIT
//
// Statements and calls. Activations are on the stack of the thread or fiber. A backend may leave a
// shader by a jump, so nothing here may rely on a destructor.
#include <alloca.h>
#include <kaamos/shader/checked.h>
#include <kaamos/shader/coverage.h>
#include <kaamos/shader/debugging.h>
#include <kaamos/shader/prelude.h>

#include <cstring>
#include <new>

#include "runtime/hlsl/analysis/trace_calls.h"
#include "runtime/hlsl/interpret/evaluate.h"

namespace kaamos::hlsl::interpret {

using ir::StmtKind;

namespace {

enum class Flow { kNext, kBreak, kContinue, kReturn };

Flow run(const Actions& actions, Frame& frame);

InterpretPlace place_of(const Context& context, const ir::Location& location) {
  return {context.program->module.get(), context.entry, location, context.invocation};
}

// Returns true if the invocation has used up its steps. The device is then removed, and on backends
// that can leave a shader that call does not return.
bool out_of_steps(Context& context, const ir::Location& location) {
  if (context.steps_left != 0) {
    --context.steps_left;
    return false;
  }
  if (!context.ended) {
    report(context, InterpretFinding::kStepLimit, location);
    context.ended = true;
    context.invocation->dispatch->services->remove_device(*context.invocation,
                                                          shader::RemovalReason::kStepLimit);
  }
  return true;
}

void assign(const Node& place, const Node& value_node, Frame& frame) {
  const std::byte* value = evaluate(value_node, frame);
  if (place.components.size() <= 1) {
    std::byte* to = place.locate(place, frame);
    if (to != nullptr) std::memmove(to, value, value_node.bytes);
    return;
  }
  std::byte* base = place.operands[0]->locate(*place.operands[0], frame);
  if (base == nullptr) return;
  // Copied through the place's own slot, because v.xy = v reads what it writes.
  std::byte* copy = frame.temporaries + place.slot;
  std::memcpy(copy, value, value_node.bytes);
  for (size_t i = 0; i < place.components.size(); ++i) {
    std::memcpy(base + place.components[i] * place.stride, copy + i * place.stride, place.stride);
  }
}

// The callee's variables are allocated by alloca here, so this must not be inlined into a loop.
[[gnu::noinline]] void call(const Action& action, Frame& frame) {
  const Code& callee = *action.callee;
  Frame inner;
  inner.context = frame.context;
  inner.variables = static_cast<std::byte*>(alloca(callee.variable_bytes + 16));
  inner.temporaries = static_cast<std::byte*>(alloca(callee.temporary_bytes + 16));
  inner.result = action.result != nullptr ? action.result->locate(*action.result, frame) : nullptr;
  const auto& parameters = callee.function->parameters;
  for (size_t i = 0; i < parameters.size(); ++i) {
    const Node& argument = *action.arguments[i];
    std::byte* to = inner.variables + callee.parameters[i];
    if (parameters[i]->mode == ir::ParameterMode::kIn) {
      std::memcpy(to, evaluate(argument, frame), argument.bytes);
      continue;
    }
    std::byte* reference = argument.locate(argument, frame);
    std::memcpy(to, &reference, sizeof(reference));
    if (parameters[i]->mode == ir::ParameterMode::kOut) {
      std::memset(reference, 0, argument.bytes);
    }
  }
  const WavePlace* const place = action.place_in_wave;
  enter_path(action, *frame.context);
  if (place != nullptr) frame.context->path_depth += place->depth + 1;
  run_body(callee, inner);
  if (place != nullptr) frame.context->path_depth -= place->depth + 1;
}

// Passes a payload or callable data with the header that the receiving shader reads, and with room
// after it. It is on the stack, so this must not be inlined into a loop.
template <class Call>
[[gnu::noinline]] void call_with_header(const Action& action, Frame& frame, const Call& call) {
  using shader::checked::PayloadHeader;
  std::byte* place = action.place->locate(*action.place, frame);
  if (!frame.context->program->checked) return call(place);
  const uint32_t bytes = action.place->bytes;
  auto* box = static_cast<std::byte*>(
      alloca(sizeof(PayloadHeader) + bytes + shader::checked::kPayloadSlack + 16));
  box += -reinterpret_cast<uintptr_t>(box) & 15u;
  const PayloadHeader header = {shader::checked::kPayloadMagic, type_hash(action.place->expr->type),
                                bytes, 0};
  std::byte* data = box + sizeof(header);
  std::memcpy(box, &header, sizeof(header));
  std::memcpy(data, place, bytes);
  std::memset(data + bytes, 0, shader::checked::kPayloadSlack);
  call(data);
  std::memcpy(place, data, bytes);
}

void trace_ray(const Action& action, Frame& frame) {
  shader::Invocation& invocation = *frame.context->invocation;
  const auto& operands = action.operands;
  const auto scene = evaluate_as<shader::Descriptor>(*operands[0], frame);
  const auto number = [&](size_t i) { return evaluate_as<uint32_t>(*operands[i], frame); };
  const bool usable = scene.kind == shader::DescriptorKind::kAccelerationStructure;
  shader::TraceRayArguments arguments;
  arguments.acceleration_structure = usable ? scene.address : 0;
  arguments.ray_flags = number(1);
  arguments.instance_inclusion_mask = number(2) & 0xFFu;
  arguments.ray_contribution_to_hit_group_index = number(3) & 0xFu;
  arguments.multiplier_for_geometry_contribution = number(4) & 0xFu;
  arguments.miss_shader_index = number(5) & 0xFFFFu;
  arguments.payload_bytes = action.place->bytes;
  const auto ray = evaluate_as<shader::RayDesc>(*operands[6], frame);
  if (frame.context->program->checked) {
    if (is_unknown(*frame.context->program->module, *action.stmt)) {
      using namespace shader::checked;
      reached(invocation, shader::ReachedBy::kTraceRay, site_of(action.stmt->location),
              structure_of(scene), arguments.ray_flags,
              trace_indices(
                  arguments.instance_inclusion_mask, arguments.ray_contribution_to_hit_group_index,
                  arguments.multiplier_for_geometry_contribution, arguments.miss_shader_index));
    }
    shader::checked::check_trace(invocation, site_of(action.stmt->location), arguments.ray_flags,
                                 ray);
  }
  const shader::Services& services = *invocation.dispatch->services;
  if (action.result == nullptr) {
    return call_with_header(action, frame, [&](void* payload) {
      services.trace_ray(invocation, arguments, payload, shader::origin_t_min(ray),
                         shader::direction_t_max(ray));
    });
  }
  shader::HitObject hit;
  call_with_header(action, frame, [&](void* payload) {
    services.trace_hit_object(invocation, arguments, payload, shader::origin_t_min(ray),
                              shader::direction_t_max(ray), hit);
  });
  std::memcpy(action.result->locate(*action.result, frame), &hit, sizeof(hit));
}

void invoke(const Action& action, Frame& frame) {
  shader::Invocation& invocation = *frame.context->invocation;
  const auto hit = evaluate_as<shader::HitObject>(*action.operands[0], frame);
  if (frame.context->program->checked) {
    shader::checked::check_depth(invocation, site_of(action.stmt->location));
  }
  call_with_header(action, frame, [&](void* payload) {
    invocation.dispatch->services->invoke_hit_object(invocation, hit, payload, action.place->bytes);
  });
}

void run_query(const Action& action, Frame& frame) {
  shader::Invocation& invocation = *frame.context->invocation;
  auto& query = *reinterpret_cast<shader::RayQuery*>(action.place->locate(*action.place, frame));
  const auto& operands = action.operands;
  const bool checked = frame.context->program->checked;
  const uint32_t site = site_of(action.stmt->location);
  switch (action.stmt->query) {
    case ir::QueryOp::kTrace:
      if (checked) {
        shader::checked::reached_inline(
            invocation, site, is_unknown(*frame.context->program->module, *action.stmt),
            evaluate_as<shader::Descriptor>(*operands[0], frame),
            evaluate_as<uint32_t>(*operands[1], frame), evaluate_as<uint32_t>(*operands[2], frame));
        shader::checked::check_query_trace(invocation, site,
                                           evaluate_as<uint32_t>(*operands[1], frame),
                                           evaluate_as<shader::RayDesc>(*operands[3], frame));
      }
      shader::begin_query(invocation, query, evaluate_as<shader::Descriptor>(*operands[0], frame),
                          evaluate_as<uint32_t>(*operands[1], frame),
                          evaluate_as<uint32_t>(*operands[2], frame),
                          evaluate_as<shader::RayDesc>(*operands[3], frame));
      return;
    case ir::QueryOp::kProceed: {
      const bool goes_on = shader::query_proceed(invocation, query);
      if (action.result != nullptr) {
        std::memcpy(action.result->locate(*action.result, frame), &goes_on, sizeof(goes_on));
      }
      return;
    }
    case ir::QueryOp::kAbort:
      return shader::query_abort(query);
    case ir::QueryOp::kCommitTriangle:
      if (checked) return shader::checked::query_commit_triangle(invocation, site, query);
      return shader::query_commit_triangle(query);
    case ir::QueryOp::kCommitProcedural:
      if (checked) {
        return shader::checked::query_commit_procedural(invocation, site, query,
                                                        evaluate_as<float>(*operands[0], frame));
      }
      return shader::query_commit_procedural(query, evaluate_as<float>(*operands[0], frame));
  }
}

void report_hit(const Action& action, Frame& frame) {
  Context& context = *frame.context;
  const auto t = evaluate_as<float>(*action.operands[0], frame);
  const auto kind = evaluate_as<uint32_t>(*action.operands[1], frame);
  const std::byte* attributes = evaluate(*action.operands[2], frame);
  if (context.program->checked) {
    shader::checked::check_hit_kind(*context.invocation, site_of(action.stmt->location), kind);
  }
  const shader::ReportHitResult result = context.invocation->dispatch->services->report_hit(
      *context.invocation, t, kind, attributes, action.operands[2]->bytes);
  if (result == shader::ReportHitResult::kEndSearch) context.ended = true;
  if (action.result != nullptr) {
    const bool accepted = result != shader::ReportHitResult::kRejected;
    std::memcpy(action.result->locate(*action.result, frame), &accepted, sizeof(accepted));
  }
}

void call_shader(const Action& action, Frame& frame) {
  shader::Invocation& invocation = *frame.context->invocation;
  const auto index = evaluate_as<uint32_t>(*action.operands[0], frame);
  if (frame.context->program->checked &&
      is_unknown(*frame.context->program->module, *action.stmt)) {
    shader::checked::reached(invocation, shader::ReachedBy::kCallShader,
                             site_of(action.stmt->location), 0, 0, index);
  }
  call_with_header(action, frame, [&](void* data) {
    invocation.dispatch->services->call_shader(invocation, index, data, action.place->bytes);
  });
}

// { prelude; if (!value) leave }. Returns kNext, kBreak to leave, or kReturn.
Flow test(const Action& loop, Frame& frame) {
  const Flow flow = run(loop.prelude, frame);
  if (flow != Flow::kNext) return flow;
  const bool goes_on = loop.value == nullptr || evaluate_as<bool>(*loop.value, frame);
  return goes_on ? Flow::kNext : Flow::kBreak;
}

Flow run_loop(const Action& loop, Frame& frame) {
  const bool test_at_end = loop.stmt->test_at_end;
  uint32_t* const iteration = iteration_in_path(loop, *frame.context);
  for (;;) {
    if (iteration != nullptr) ++*iteration;
    if (out_of_steps(*frame.context, loop.stmt->location)) return Flow::kReturn;
    Flow flow = test_at_end ? Flow::kNext : test(loop, frame);
    if (flow == Flow::kNext) flow = run(loop.body, frame);
    if (flow == Flow::kNext || flow == Flow::kContinue) flow = run(loop.step, frame);
    if (flow == Flow::kNext && test_at_end) flow = test(loop, frame);
    if (flow == Flow::kBreak) return Flow::kNext;
    if (flow == Flow::kReturn) return flow;
  }
}

int64_t selector_of(const Node& node, Frame& frame) {
  switch (node.expr->type->scalar) {
    case ir::Scalar::kBool:
      return evaluate_as<bool>(node, frame);
    case ir::Scalar::kInt16:
      return evaluate_as<int16_t>(node, frame);
    case ir::Scalar::kUint16:
      return evaluate_as<uint16_t>(node, frame);
    case ir::Scalar::kInt32:
      return evaluate_as<int32_t>(node, frame);
    case ir::Scalar::kUint32:
      return evaluate_as<uint32_t>(node, frame);
    default:
      return evaluate_as<int64_t>(node, frame);
  }
}

// Compares in the selector's width, because the checker sign-extends a label that an unsigned
// selector wraps.
bool matches(int64_t label, int64_t selector, uint32_t bytes) {
  const uint64_t mask = bytes >= 8 ? ~uint64_t{0} : (uint64_t{1} << (bytes * 8)) - 1;
  return ((static_cast<uint64_t>(label) ^ static_cast<uint64_t>(selector)) & mask) == 0;
}

Flow run_switch(const Action& action, Frame& frame) {
  const int64_t selector = selector_of(*action.value, frame);
  size_t chosen = action.cases.size();
  for (size_t i = 0; i < action.cases.size(); ++i) {
    const ActionCase& c = action.cases[i];
    for (const int64_t label : c.labels) {
      if (!matches(label, selector, action.value->bytes)) continue;
      chosen = i;
      i = action.cases.size() - 1;  // a label occurs only once
      break;
    }
    if (c.is_default && chosen == action.cases.size()) chosen = i;
  }
  for (size_t i = chosen; i < action.cases.size(); ++i) {
    const Flow flow = run(action.cases[i].body, frame);
    if (flow == Flow::kBreak) return Flow::kNext;
    if (flow != Flow::kNext) return flow;
  }
  return Flow::kNext;
}

void emit_vertex(const Action& action, Frame& frame) {
  shader::GeometryStream& stream = *frame.context->stream;
  if (stream.count >= stream.most) return;
  uint32_t* words = stream.rows + size_t{stream.count} * stream.columns;
  for (const Node* operand : action.operands) {
    std::memcpy(words, evaluate(*operand, frame), operand->bytes);
    words += operand->bytes / sizeof(uint32_t);
  }
  stream.begins[stream.count++] = stream.cut;
  stream.cut = false;
}

Flow end_shader(Context& context, shader::AnyHitResult result) {
  context.any_hit = result;
  context.ended = true;
  return Flow::kReturn;
}

Flow run(const Action& action, Frame& frame) {
  Context& context = *frame.context;
  const ir::Stmt& stmt = *action.stmt;
  if (stmt.kind == StmtKind::kCover) {  // no step of the program
    shader::cover(context.program->covered[stmt.point]);
    return Flow::kNext;
  }
  if (out_of_steps(context, stmt.location)) return Flow::kReturn;
  const InterpretHooks& hooks = context.program->options.hooks;
  if (hooks.statement != nullptr && stmt.location.line != 0) {
    hooks.statement(hooks.user, place_of(context, stmt.location));
  }
  switch (stmt.kind) {
    case StmtKind::kBlock:
      return run(action.body, frame);
    case StmtKind::kDeclare: {
      std::byte* to = frame.variables + action.offset;
      if (stmt.variable->type->is_query()) {
        new (to) shader::RayQuery();
        return Flow::kNext;
      }
      if (action.value != nullptr) {
        std::memmove(to, evaluate(*action.value, frame), action.value->bytes);
      } else {
        std::memset(to, 0, action.bytes);
      }
      return Flow::kNext;
    }
    case StmtKind::kAssign:
      assign(*action.place, *action.value, frame);
      return Flow::kNext;
    case StmtKind::kStore:
      store(action, frame);
      return Flow::kNext;
    case StmtKind::kStoreElement:
      store_element(action, frame);
      return Flow::kNext;
    case StmtKind::kTypedStore:
      typed_store(action, frame);
      return Flow::kNext;
    case StmtKind::kAtomic:
      run_atomic(action, frame);
      return Flow::kNext;
    case StmtKind::kCall:
      call(action, frame);
      return context.ended && !stmt.outlives_end ? Flow::kReturn : Flow::kNext;
    case StmtKind::kTraceRay:
      trace_ray(action, frame);
      return Flow::kNext;
    case StmtKind::kInvoke:
      invoke(action, frame);
      return Flow::kNext;
    case StmtKind::kQuery:
      run_query(action, frame);
      return Flow::kNext;
    case StmtKind::kWave:
      run_wave(action, frame);
      return Flow::kNext;
    case StmtKind::kReportHit:
      report_hit(action, frame);
      return context.ended ? Flow::kReturn : Flow::kNext;
    case StmtKind::kCallShader:
      call_shader(action, frame);
      return Flow::kNext;
    case StmtKind::kIgnoreHit:
      return end_shader(context, shader::AnyHitResult::kIgnore);
    case StmtKind::kAcceptHitAndEndSearch:
      return end_shader(context, shader::AnyHitResult::kAcceptAndEndSearch);
    case StmtKind::kRemoveDevice:
      context.invocation->dispatch->services->remove_device(
          *context.invocation, static_cast<shader::RemovalReason>(stmt.removal));
      return Flow::kNext;
    case StmtKind::kDebugBreak:
      if (shader::is_debugging_enabled(*context.invocation) != 0) {
        KAAMOS_BREAKPOINT();
      } else if (context.program->checked) {
        shader::report_break(*context.invocation, site_of(stmt.location));
      }
      return Flow::kNext;
    case StmtKind::kDiscard:  // the assignment before it is enough
      return Flow::kNext;
    case StmtKind::kEmitVertex:
      emit_vertex(action, frame);
      return Flow::kNext;
    case StmtKind::kCutStrip:
      context.stream->cut = true;
      return Flow::kNext;
    case StmtKind::kCover:
      return Flow::kNext;
    case StmtKind::kIf:
      return run(evaluate_as<bool>(*action.value, frame) ? action.body : action.orelse, frame);
    case StmtKind::kLoop:
      return run_loop(action, frame);
    case StmtKind::kSwitch:
      return run_switch(action, frame);
    case StmtKind::kBreak:
      return Flow::kBreak;
    case StmtKind::kContinue:
      return Flow::kContinue;
    case StmtKind::kReturn:
      if (action.value != nullptr && frame.result != nullptr) {
        std::memmove(frame.result, evaluate(*action.value, frame), action.value->bytes);
        frame.result = nullptr;
      }
      return Flow::kReturn;
    case StmtKind::kBarrier:
      shader::barrier(*context.invocation, context.group, stmt.barrier);
      return Flow::kNext;
  }
  return Flow::kNext;
}

Flow run(const Actions& actions, Frame& frame) {
  for (const Action* action : actions) {
    const Flow flow = run(*action, frame);
    if (flow != Flow::kNext) return flow;
  }
  return Flow::kNext;
}

}  // namespace

void run_body(const Code& code, Frame& frame) {
  run(code.body, frame);
  // A function that ends without returning a value, or in which the shader ends, returns zero.
  if (frame.result != nullptr) std::memset(frame.result, 0, code.result_bytes);
}

void report(Context& context, InterpretFinding finding, const ir::Location& location) {
  const InterpretHooks& hooks = context.program->options.hooks;
  if (hooks.finding != nullptr) hooks.finding(hooks.user, finding, place_of(context, location));
}

}  // namespace kaamos::hlsl::interpret
