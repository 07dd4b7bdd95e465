// SPDX-License-Identifier: MIT
//
// Statements: everything that has an effect.
#include <algorithm>

#include "kaamos/shader/debugging.h"
#include "runtime/hlsl/analysis/wave_paths.h"
#include "runtime/hlsl/glsl/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

// Returns whether the block, as a loop's body, contains a `continue` for that loop.
bool has_continue(const Block& block) {
  for (const Stmt* stmt : block) {
    if (stmt->kind == StmtKind::kContinue) {
      return true;
    }
    if (stmt->kind == StmtKind::kLoop) {
      continue;
    }
    if (has_continue(stmt->body) || has_continue(stmt->orelse)) {
      return true;
    }
    for (const SwitchCase& c : stmt->cases) {
      if (has_continue(c.body)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

void GlslEmitter::block(const Block& body) {
  for (const Stmt* stmt : body) {
    statement(*stmt);
  }
}

void GlslEmitter::end_shader() {
  line(current_->result->kind == TypeKind::kVoid ? "return;"
                                                 : "return " + zero(current_->result) + ";");
}

void GlslEmitter::return_if_ended() {
  open("if (g_ended != 0u) {");
  end_shader();
  close("}");
}

void GlslEmitter::declare(const Stmt& stmt) {
  const std::string t = type(stmt.variable->type);
  const bool numbers = stmt.variable->type->kind == TypeKind::kScalar ||
                       stmt.variable->type->kind == TypeKind::kVector;
  const std::string initial = stmt.value != nullptr ? value(stmt.value)
                              : numbers             ? zero(stmt.variable->type)
                                                    : "{}";
  auto& name = variable_names_[stmt.variable];
  // A loop's step may be printed several times, so the name may be there already.
  if (name.empty()) {
    name = local_names_.add(stmt.variable->name);
  }
  if (stmt.variable->type->is_query()) {
    line(t + " " + name + ";");
    line("g_Query g_s_" + name + " = {};");
    return;
  }
  line(t + " " + name + " = " + initial + ";");
}

void GlslEmitter::assign(const Stmt& stmt) {
  const Expr* target = stmt.place;
  if (target->kind == ExprKind::kMatrixSwizzle && target->components.size() > 1) {
    const Path m = path(target->operands[0]);
    const std::string text = repeatable(stmt.value);
    const std::string guard = m.guard();
    for (size_t i = 0; i < target->components.size(); ++i) {
      const int component = target->components[i];
      const std::string column =
          target->operands[0]->type->columns == 1 ? "" : "." + glsl::component(component % 4);
      line((guard.empty() ? "" : "if (" + guard + ") ") + m.text + ".r[" +
           std::to_string(component / 4) + "]" + column + " = " + text + "." +
           glsl::component(static_cast<int>(i)) + ";");
    }
    return;
  }
  const Path p = path(target);
  const std::string text = value(stmt.value);
  const std::string guard = p.guard();
  line((guard.empty() ? "" : "if (" + guard + ") ") + p.text + " = " + text + ";");
}

void GlslEmitter::call_function(const Stmt& stmt) {
  const std::string result = stmt.result != nullptr ? variable(stmt.result) + " = " : "";
  std::string arguments;
  for (const Expr* argument : stmt.arguments) {
    arguments += arguments.empty() ? "" : ", ";
    arguments += argument->type->is_query() ? query_arguments(argument) : value(argument);
  }
  line(result + function_names_[stmt.function] + "(" + arguments + ");");
  if (stmt.function->may_end_shader && !stmt.outlives_end) {
    return_if_ended();
  }
}

void GlslEmitter::loop_condition(const Stmt& stmt) {
  block(stmt.prelude);
  if (stmt.value != nullptr) {
    line("if (!(" + value(stmt.value) + ")) break;");
  }
}

// GLSL has no goto. If a `continue` has to get to a condition at the loop's end, the step and
// condition are placed at the start of the next iteration; otherwise the step is repeated before
// each `continue`. Lanes must come to a wave operation in the step together, so it is not repeated.
void GlslEmitter::loop(const Stmt& stmt) {
  const bool together = std::any_of(stmt.step.begin(), stmt.step.end(),
                                    [](const Stmt* step) { return reaches_wave(*step); });
  const bool flagged = (stmt.test_at_end || together) && has_continue(stmt.body);
  std::string again;
  if (flagged) {
    again = hoist("bool", "false");
  }
  open("for (;;) {");
  if (flagged) {
    open("if (" + again + ") {");
    block(stmt.step);
    if (stmt.test_at_end) loop_condition(stmt);
    close("}");
    line(again + " = true;");
    if (!stmt.test_at_end) loop_condition(stmt);
  } else if (!stmt.test_at_end) {
    loop_condition(stmt);
  }
  loops_.push_back({&stmt, flagged});
  open("{");
  block(stmt.body);
  close("}");
  loops_.pop_back();
  if (!flagged) {
    block(stmt.step);
    if (stmt.test_at_end) {
      loop_condition(stmt);
    }
  }
  close("}");
}

void GlslEmitter::continue_loop() {
  const Loop innermost = loops_.back();
  if (!innermost.flagged) {
    open("{");
    block(innermost.stmt->step);
    close("}");
  }
  line("continue;");
}

void GlslEmitter::switch_(const Stmt& stmt) {
  if (stmt.cases.empty()) {
    return;
  }
  const Scalar scalar =
      stmt.value->type->scalar == Scalar::kUint32 ? Scalar::kUint32 : Scalar::kInt32;
  const std::string selector = value(stmt.value);
  open("switch (" +
       (stmt.value->type->scalar == scalar ? selector
                                           : glsl::scalar_name(scalar) + "(" + selector + ")") +
       ") {");
  for (const SwitchCase& c : stmt.cases) {
    for (const int64_t label : c.labels) {
      line("case " + scalar_literal(scalar, static_cast<uint64_t>(label)) + ":");
    }
    if (c.is_default) {
      line("default:");
    }
    open("{");
    block(c.body);
    close("}");
  }
  line("break;");  // a label at the end needs a statement
  close("}");
}

void GlslEmitter::barrier(uint32_t flags) {
  if (entry_.stage != kStageCompute) {
    line("memoryBarrier();");
    return;
  }
  if ((flags & kDeviceMemory) != 0) {
    line("memoryBarrier();");
  } else if ((flags & kGroupMemory) != 0) {
    line("memoryBarrierShared();");
  }
  if ((flags & kGroupSync) != 0) {
    line("barrier();");
  }
}

void GlslEmitter::statement(const Stmt& stmt) {
  if (stmt.kind != StmtKind::kBlock) statement_location_ = stmt.location;
  switch (stmt.kind) {
    case StmtKind::kBlock:
      open("{");
      block(stmt.body);
      close("}");
      break;
    case StmtKind::kDeclare:
      declare(stmt);
      break;
    case StmtKind::kAssign:
      assign(stmt);
      break;
    case StmtKind::kStore:
    case StmtKind::kStoreElement:
      store(stmt);
      break;
    case StmtKind::kTypedStore:
      typed_store(stmt);
      break;
    case StmtKind::kAtomic:
      atomic(stmt);
      break;
    case StmtKind::kCall:
      call_function(stmt);
      break;
    case StmtKind::kTraceRay:
      trace_ray(stmt);
      break;
    case StmtKind::kInvoke:
      invoke(stmt);
      break;
    case StmtKind::kQuery:
      query(stmt);
      break;
    case StmtKind::kWave:
      wave(stmt);
      break;
    case StmtKind::kReportHit:
      report_hit(stmt);
      break;
    case StmtKind::kCallShader:
      call_shader(stmt);
      break;
    case StmtKind::kIgnoreHit:
    case StmtKind::kAcceptHitAndEndSearch:
      line(stmt.kind == StmtKind::kIgnoreHit ? "g_ended = 1u;" : "g_ended = 2u;");
      end_shader();
      break;
    case StmtKind::kRemoveDevice:
      declare_remove_device();
      line("g_remove_device(" + glsl::number(static_cast<uint32_t>(stmt.removal)) + ");");
      break;
    case StmtKind::kDebugBreak:
      if (module_.check_access) {
        line("k_tell(" + glsl::number(static_cast<uint32_t>(shader::kBreakWithoutDebugger)) + ", " +
             site(stmt.location) + ", 0u, 0u, 0UL, 0UL, 0UL, 0UL);");
      }
      break;
    case StmtKind::kDiscard:
      line("demote;");
      break;
    case StmtKind::kEmitVertex:
      emit_vertex(stmt);
      break;
    case StmtKind::kCutStrip:
      line("EndPrimitive();");
      break;
    case StmtKind::kCover:
      cover(stmt.point);
      break;
    case StmtKind::kIf:
      open("if (" + value(stmt.value) + ") {");
      block(stmt.body);
      if (!stmt.orelse.empty()) {
        close("} else {");
        ++indent_;
        block(stmt.orelse);
      }
      close("}");
      break;
    case StmtKind::kLoop:
      loop(stmt);
      break;
    case StmtKind::kSwitch:
      switch_(stmt);
      break;
    case StmtKind::kBreak:
      line("break;");
      break;
    case StmtKind::kContinue:
      continue_loop();
      break;
    case StmtKind::kReturn:
      line(stmt.value != nullptr ? "return " + value(stmt.value) + ";" : "return;");
      break;
    case StmtKind::kBarrier:
      barrier(stmt.barrier);
      break;
  }
}

}  // namespace kaamos::hlsl
