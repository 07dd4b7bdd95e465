// SPDX-License-Identifier: MIT
//
// Statements under masks. A jump removes lanes from the mask that it runs under; the masks of
// enclosing statements are then combined with what is left. A scope whose mask has become empty is
// left.
#include <algorithm>

#include "runtime/hlsl/cpp/wide_emitter.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

bool is_swizzle(const Expr* place) {
  return place->components.size() > 1 &&
         (place->kind == ExprKind::kSwizzle || place->kind == ExprKind::kMatrixSwizzle);
}

}  // namespace

std::string WideEmitter::declare_mask(const std::string& value) {
  const std::string name = out_.local_names_.declare("mask");
  line("[[maybe_unused]] ks::lanes " + name + (value == "{}" ? "{};" : " = " + value + ";"));
  return name;
}

void WideEmitter::block(const Block& body) {
  for (size_t i = 0; i < body.size(); ++i) {
    if (begins_with_call(body, i) && !facts(*body[i + 1]).blends) {
      out_.begin_statement(*body[++i]);
      call_function(*body[i], true);
    } else {
      statement(*body[i]);
    }
    if (i + 1 < body.size() && facts(*body[i]).narrows) {
      line("if (ks::no_lane(" + mask_ + ")) goto skip_" + std::to_string(skip_label_) + ";");
      skip_used_ = true;
    }
  }
}

void WideEmitter::scope(const Block& body) {
  const int outer_label = skip_label_;
  const bool outer_used = skip_used_;
  skip_label_ = out_.next_label_++;
  skip_used_ = false;
  open("{");
  out_.local_names_.push();
  block(body);
  out_.local_names_.pop();
  close("}");
  if (skip_used_) line("skip_" + std::to_string(skip_label_) + ":;");
  skip_label_ = outer_label;
  skip_used_ = outer_used;
}

void WideEmitter::declare(const Stmt& stmt) {
  if (!current_->is_varying(stmt.variable)) return out_.declare(stmt);
  const std::string initial = stmt.value != nullptr ? " = " + value(stmt.value) : "{}";
  line(type(stmt.variable->type) + " " + out_.name_local(stmt.variable) + initial + ";");
  if (stmt.value != nullptr) declare_texel_row(stmt.variable, stmt.value);
}

// For a variable that never changes; `value` is null for a parameter.
void WideEmitter::declare_texel_row(const Variable* variable, const Expr* value) {
  if (!has_texel_row(variable)) return;
  std::string row = value != nullptr ? texel_row(value) : "";
  if (row.empty()) row = "ks::texel_row(" + out_.variable(variable) + ")";
  const std::string name = out_.local_names_.declare(out_.variable(variable) + "_row");
  line("[[maybe_unused]] const ks::TexelRow " + name + " = " + row + ";");
  texel_rows_[variable] = name;
}

// Writes to a different element in each lane.
void WideEmitter::write_lanes(const Expr* target, const std::string& text) {
  LaneOperands operands;
  const auto path = [&](const auto& self, const Expr& expr) -> std::string {
    const std::string base = expr.kind == ExprKind::kVariable ? "" : self(self, *expr.operands[0]);
    switch (expr.kind) {
      case ExprKind::kVariable:
        return out_.variable(expr.variable);
      case ExprKind::kField:
        return base + "." + field(expr);
      case ExprKind::kElement:
        if (expr.operands[0]->type->kind == TypeKind::kScalar) return base;
        add_operand(operands, expr.operands[1]);
        return "ks::element_ref(" + base + ", " + operands.text[expr.operands[1]] + ")" +
               behind_row(expr.operands[0]->type);
      case ExprKind::kSwizzle:
        return expr.operands[0]->type->kind == TypeKind::kScalar
                   ? base
                   : base + "[" + std::to_string(expr.components[0]) + "]";
      default:  // kMatrixSwizzle
        return base + "[" + std::to_string(expr.components[0] / 4) + "][" +
               std::to_string(expr.components[0] % 4) + "]";
    }
  };
  const bool several = is_swizzle(target);
  const std::string place = path(path, several ? *target->operands[0] : *target);
  open("ks::each_lane(" + mask_ + ", [&, lane_value = " + text + operands.captures +
       "](int lane_number) KAAMOS_INLINE_LAMBDA {");
  if (several) {
    const std::string t = out_.type(target->operands[0]->type);
    const bool swizzle = target->kind == ExprKind::kSwizzle;
    line("ks::change_lane(" + place + ", lane_number, [&](" + t + "& whole) {");
    line(std::string(swizzle ? "  ks::assign_swizzle<" : "  ks::assign_matrix_swizzle<") +
         component_list(target->components) + ">(whole, ks::get(lane_value, lane_number));");
    line("});");
  } else {
    line("ks::set(" + place + ", lane_number, ks::get(lane_value, lane_number));");
  }
  close("});");
}

void WideEmitter::write(const Expr* target, const std::string& text, bool blends) {
  for (const Expr* e = target; e->kind != ExprKind::kVariable; e = e->operands[0]) {
    if (e->kind == ExprKind::kElement && is_varying(e->operands[1])) {
      return write_lanes(target, text);
    }
  }
  if (is_swizzle(target)) {
    const bool swizzle = target->kind == ExprKind::kSwizzle;
    line(std::string("ks::") + (blends ? "blend" : "assign") +
         (swizzle ? "_swizzle<" : "_matrix_swizzle<") + component_list(target->components) + ">(" +
         place(target->operands[0]) + ", " + text + (blends ? ", " + mask_ : "") + ");");
    return;
  }
  if (blends) {
    line("ks::blend(" + place(target) + ", " + text + ", " + mask_ + ");");
  } else {
    line(place(target) + " = " + text + ";");
  }
}

void WideEmitter::assign(const Stmt& stmt) {
  const Expr* root = stmt.place;
  while (root->kind != ExprKind::kVariable) root = root->operands[0];
  if (!is_varying(root)) return out_.assign(stmt.place, out_.value(stmt.value));
  write(stmt.place, value(stmt.value), facts(stmt).blends);
}

void WideEmitter::store(const Stmt& stmt) {
  const bool element = stmt.kind == StmtKind::kStoreElement;
  LaneOperands operands;
  const std::string view = buffer_view(operands, stmt.operands, element);
  add_operand(operands, stmt.value);
  const auto text = [&](const Expr* expr) { return operands.text.at(expr); };
  open("ks::each_lane(" + mask_ + ", [&" + operands.captures +
       "]([[maybe_unused]] int lane_number) KAAMOS_INLINE_LAMBDA {");
  line(out_.memory_write(stmt.value->type, stmt.layout, stmt.row_major, view,
                         text(stmt.operands.back()), text(stmt.value)) +
       ";");
  close("});");
}

void WideEmitter::typed_store(const Stmt& stmt) {
  const Type* resource = stmt.operands[0]->type;
  const bool buffer = resource->resource == ResourceKind::kRWBuffer;
  if (resource->resource == ResourceKind::kRWTexture2D && out_.is_looked_up(*stmt.operands[0]) &&
      stmt.operands[1]->type->columns == 2) {
    line("ks::store_texels<" + out_.type(stmt.value->type) + ">(ctx.invocation, " +
         out_.texture(stmt.operands[0]) + ", " + texel_coordinates(stmt.operands[1]) + ", " +
         value(stmt.value) + ", " + mask_ + ");");
    return;
  }
  LaneOperands operands;
  add_operand(operands, stmt.operands[1]);
  add_operand(operands, stmt.value);
  const std::string at = operands.text.at(stmt.operands[1]);
  open("ks::each_lane(" + mask_ + ", [&" + operands.captures +
       "]([[maybe_unused]] int lane_number) KAAMOS_INLINE_LAMBDA {");
  line(std::string(buffer ? "ks::store_typed" : "ks::store_texel") + "(ctx.invocation, " +
       (buffer ? out_.value(stmt.operands[0]) + ", uint32_t(" + at + ")"
               : out_.texture(stmt.operands[0]) + ", " +
                     out_.texel_coordinates_text(resource, at, "0", "")) +
       ", " + operands.text.at(stmt.value) + ");");
  close("});");
}

void WideEmitter::atomic(const Stmt& stmt) {
  LaneOperands operands;
  for (const Expr* operand : stmt.operands) add_operand(operands, operand);
  add_operand(operands, stmt.value);
  if (stmt.compare != nullptr) add_operand(operands, stmt.compare);
  const auto text = [&](const Expr* expr) { return operands.text.at(expr); };
  open("ks::each_lane(" + mask_ + ", [&" + operands.captures +
       "](int lane_number) KAAMOS_INLINE_LAMBDA {");
  const std::string call = out_.atomic_text(stmt, text);
  if (stmt.result != nullptr) {
    line("ks::set(" + out_.variable(stmt.result) + ", lane_number, " + call + ");");
  } else {
    line("static_cast<void>(lane_number);");
    line(call + ";");
  }
  close("});");
}

// If all rays are traced with the same parameters, the backend gets them together, otherwise one by
// one.
void WideEmitter::trace_ray(const Stmt& stmt) {
  const std::string payload = out_.variable(stmt.place->variable);
  const Expr* ray = stmt.operands.back();
  if (std::none_of(stmt.operands.begin(), stmt.operands.end() - 1,
                   [this](const Expr* operand) { return is_varying(operand); })) {
    std::string text = "ks::trace_rays(ctx.invocation, ctx.first_x, " + mask_;
    for (const Expr* operand : stmt.operands) {
      text += ", " + (operand == ray ? value(operand) : out_.value(operand));
    }
    return line(text + ", " + payload + ");");
  }
  LaneOperands operands;
  for (const Expr* operand : stmt.operands) add_operand(operands, operand);
  open("ks::each_lane(" + mask_ + ", [&" + operands.captures +
       "](int lane_number) KAAMOS_INLINE_LAMBDA {");
  line("ctx.set_invocation(lane_number);");
  line("auto lane_value = ks::get(" + payload + ", lane_number);");
  std::string text = "ks::trace_ray(ctx.invocation";
  for (const Expr* operand : stmt.operands) text += ", " + operands.text.at(operand);
  line(text + ", lane_value);");
  line("ks::set(" + payload + ", lane_number, lane_value);");
  close("});");
}

void WideEmitter::call_function(const Stmt& stmt, bool declares_result) {
  const WideFunction* callee = current_->callees.at(&stmt);
  out_.enter_wave_call(stmt);
  std::string text = "u::" + names_[callee] + "(ctx, " + mask_;
  for (size_t i = 0; i < stmt.arguments.size(); ++i) {
    const Variable* parameter = stmt.function->parameters[i];
    const Expr* argument = stmt.arguments[i];
    text += ", ";
    if (parameter->mode != ParameterMode::kIn) {
      text += out_.variable(argument->variable);
    } else if (callee->only_reads(parameter) && callee_can_write(argument)) {
      text += type(parameter->type) + "(" + value(argument) + ")";  // the callee may change it
    } else {
      text += callee->is_varying(parameter) ? value(argument) : out_.value(argument);
    }
  }
  text += ")";
  if (stmt.result == nullptr) {
    line(text + ";");
    return out_.leave_wave_call(stmt);
  }
  const bool varying = current_->is_varying(stmt.result);
  if (varying && !callee->varying_result) {
    text = "ks::spread<" + type(stmt.result->type) + ">(" + text + ")";
  }
  if (declares_result) {
    const Type* t = stmt.result->type;
    line((varying ? type(t) : out_.type(t)) + " " + out_.name_local(stmt.result) + " = " + text +
         ";");
  } else if (varying && facts(stmt).blends) {
    line("ks::blend(" + out_.variable(stmt.result) + ", " + text + ", " + mask_ + ");");
  } else {
    line(out_.variable(stmt.result) + " = " + text + ";");
  }
  out_.leave_wave_call(stmt);
}

// Emits `if (condition) continue;` without a branch.
bool WideEmitter::masked_leave(const Stmt& stmt) {
  if (stmt.body.size() != 1 || !stmt.orelse.empty()) return false;
  const Stmt& jump = *stmt.body[0];
  const bool is_jump = jump.kind == StmtKind::kBreak || jump.kind == StmtKind::kContinue ||
                       (jump.kind == StmtKind::kReturn && jump.value == nullptr);
  if (!is_jump || !facts(jump).masked) return false;
  open("{");
  out_.local_names_.push();
  const std::string left = declare_mask(mask_ + " & " + value(stmt.value));
  const std::string& into = jump.kind == StmtKind::kContinue ? restarted_ : gone_;
  if (jump.kind != StmtKind::kBreak) line(into + " = " + into + " | " + left + ";");
  line(mask_ + " = " + mask_ + " & ~" + left + ";");
  out_.local_names_.pop();
  close("}");
  return true;
}

void WideEmitter::masked_if(const Stmt& stmt) {
  if (masked_leave(stmt)) return;
  const std::string outer = mask_;
  open("{");
  out_.local_names_.push();
  const std::string condition = declare_mask(value(stmt.value));
  const std::string first = declare_mask(outer + " & " + condition);
  const bool joins = facts(stmt).narrows;
  const std::string second =
      joins || !stmt.orelse.empty() ? declare_mask(outer + " & ~" + condition) : "";
  mask_ = first;
  open("if (ks::any_lane(" + first + ")) {");
  scope(stmt.body);
  close("}");
  if (!stmt.orelse.empty()) {
    mask_ = second;
    open("if (ks::any_lane(" + second + ")) {");
    scope(stmt.orelse);
    close("}");
  }
  mask_ = outer;
  if (joins) line(outer + " = " + first + " | " + second + ";");
  out_.local_names_.pop();
  close("}");
}

void WideEmitter::if_(const Stmt& stmt) {
  if (facts(stmt).masked) return masked_if(stmt);
  open("if (" + out_.value(stmt.value) + ") {");
  scope(stmt.body);
  if (!stmt.orelse.empty()) {
    close("} else {");
    ++out_.indent_;
    scope(stmt.orelse);
  }
  close("}");
}

// `mask` is the loop's; threads that leave the loop from its body are removed from it.
void WideEmitter::loop_body(const Stmt& stmt, const std::string& mask) {
  const int label = out_.next_label_++;
  const bool restarts = facts(stmt).masked_continue;
  const std::string outer_restarted = restarted_;
  if (restarts) {
    mask_ = declare_mask(mask);
    restarted_ = declare_mask("{}");
  }
  loops_.push_back(label);
  scope(stmt.body);
  loops_.pop_back();
  if (out_.used_labels_.count(label) != 0) line("continue_" + std::to_string(label) + ":;");
  if (restarts) line(mask + " = " + mask_ + " | " + restarted_ + ";");
  restarted_ = outer_restarted;
  mask_ = mask;
  if (facts(stmt).masked || facts(stmt).narrows) line("if (ks::no_lane(" + mask + ")) break;");
}

void WideEmitter::loop(const Stmt& stmt) {
  const WideFacts& f = facts(stmt);
  const std::string outer = mask_;
  const int outer_label = skip_label_;
  const bool outer_used = skip_used_;
  open("{");
  out_.local_names_.push();
  if (f.masked) mask_ = declare_mask(outer);
  const std::string mask = mask_;
  const bool unrolls = is_unrolled(stmt) && !is_varying(stmt.value);
  out_.enter_wave_loop(stmt);
  if (unrolls) line("KAAMOS_UNROLL(" + std::to_string(stmt.unroll) + ")");
  open(unrolls ? "for (; " + out_.value(stmt.value) + ";) {" : "for (;;) {");
  out_.local_names_.push();
  out_.begin_wave_iteration(stmt);
  const auto condition = [&] {
    for (const Stmt* s : stmt.prelude) statement(*s);
    if (stmt.value == nullptr) return;
    if (is_varying(stmt.value)) {
      line(mask + " = " + mask + " & " + value(stmt.value) + ";");
      line("if (ks::no_lane(" + mask + ")) break;");
    } else {
      line("if (!(" + out_.value(stmt.value) + ")) break;");
    }
  };
  if (!stmt.test_at_end && !unrolls) condition();
  loop_body(stmt, mask);
  for (const Stmt* s : stmt.step) statement(*s);
  if (stmt.test_at_end) condition();
  out_.local_names_.pop();
  close("}");
  mask_ = outer;
  if (f.masked && f.narrows) line(outer + " = " + outer + " & ~" + gone_ + ";");
  out_.local_names_.pop();
  close("}");
  skip_label_ = outer_label;
  skip_used_ = outer_used;
}

// Case by case: the threads that match a label join those that fall through from the previous case.
void WideEmitter::masked_switch(const Stmt& stmt) {
  const std::string outer = mask_;
  const std::string selector_type = type(stmt.value->type);
  open("{");
  out_.local_names_.push();
  const std::string selector = out_.local_names_.declare("selector");
  line("const " + selector_type + " " + selector + " = " + value(stmt.value) + ";");
  const auto equals = [&](int64_t label) {
    return "ks::equal(" + selector + ", ks::spread<" + selector_type + ">(" +
           out_.scalar_literal(stmt.value->type->scalar, static_cast<uint64_t>(label)) + "))";
  };
  const std::string others = declare_mask(outer);
  for (const SwitchCase& c : stmt.cases) {
    for (const int64_t label : c.labels) {
      line(others + " = " + others + " & ~" + equals(label) + ";");
    }
  }
  mask_ = declare_mask("{}");
  const std::string mask = mask_;
  for (const SwitchCase& c : stmt.cases) {
    for (const int64_t label : c.labels) {
      line(mask + " = " + mask + " | (" + outer + " & " + equals(label) + ");");
    }
    if (c.is_default) line(mask + " = " + mask + " | " + others + ";");
    open("if (ks::any_lane(" + mask + ")) {");
    scope(c.body);
    close("}");
  }
  mask_ = outer;
  if (facts(stmt).narrows) {
    std::string left = outer;
    if (!gone_.empty()) left += " & ~" + gone_;
    if (!restarted_.empty()) left += " & ~" + restarted_;
    line(outer + " = " + left + ";");
  }
  out_.local_names_.pop();
  close("}");
}

void WideEmitter::switch_(const Stmt& stmt) {
  if (facts(stmt).masked) return masked_switch(stmt);
  const Scalar scalar = stmt.value->type->scalar;
  open("switch (" + out_.value(stmt.value) + ") {");
  for (const SwitchCase& c : stmt.cases) {
    for (const int64_t label : c.labels) {
      line("case " + out_.scalar_literal(scalar, static_cast<uint64_t>(label)) + ":");
    }
    if (c.is_default) line("default:");
    open("{");
    scope(c.body);
    close("}");
  }
  close("}");
}

void WideEmitter::masked_jump(const Stmt& stmt) {
  if (stmt.kind == StmtKind::kContinue) {
    line(restarted_ + " = " + restarted_ + " | " + mask_ + ";");
  }
  if (stmt.kind == StmtKind::kReturn) {
    if (stmt.value != nullptr) {
      line("ks::blend(" + result_ + ", " + value(stmt.value) + ", " + mask_ + ");");
    }
    line(gone_ + " = " + gone_ + " | " + mask_ + ";");
  }
  line(mask_ + " = ks::lanes{};");
}

void WideEmitter::return_(const Stmt& stmt) {
  if (stmt.value == nullptr) return line("return;");
  if (!result_.empty()) {
    line("ks::blend(" + result_ + ", " + value(stmt.value) + ", " + mask_ + ");");
    return line("return " + result_ + ";");
  }
  line("return " + (current_->varying_result ? value(stmt.value) : out_.value(stmt.value)) + ";");
}

void WideEmitter::wave(const Stmt& stmt) {
  const std::string result = out_.variable(stmt.result);
  const bool varying = current_->is_varying(stmt.result);
  std::string text;
  if (stmt.wave == shader::WaveOp::kLaneCount) {
    text = "ctx.group->wave_lanes";
    if (varying) text = "ks::spread<" + type(stmt.result->type) + ">(" + text + ")";
  } else if (stmt.wave == shader::WaveOp::kGroupWaveCount) {
    text = "(ctx.group->threads + ctx.group->wave_lanes - 1) / ctx.group->wave_lanes";
    if (varying) text = "ks::spread<" + type(stmt.result->type) + ">(" + text + ")";
  } else if (stmt.wave == shader::WaveOp::kGroupWaveIndex) {
    text = "ks::wide_group_wave_index<" + type(stmt.result->type) + ">(*ctx.group, ctx.first)";
  } else if (stmt.wave == shader::WaveOp::kLaneIndex) {
    text = "ks::wide_lane_index<" + type(stmt.result->type) + ">(*ctx.group, ctx.first)";
  } else if (shader::is_derivative(stmt.wave) &&
             stmt.operands[0]->type->scalar == Scalar::kFloat32) {
    text = "ks::wide_derivative<" + out_.wave_operation(stmt) + ">(" + mask_ + ", " +
           value(stmt.operands[0]) + ")";
  } else {
    out_.enter_wave_path(stmt);
    text = "ks::wide_wave_operation<" + out_.wave_operation(stmt) + ", " + type(stmt.result->type);
    for (const Expr* operand : stmt.operands) text += ", " + type(operand->type);
    text +=
        ">(ctx.invocation, *ctx.group, " + mask_ + ", ctx.wave_path, " + out_.wave_depth(stmt, 1);
    for (const Expr* operand : stmt.operands) text += ", " + value(operand);
    text += ")";
  }
  if (varying && facts(stmt).blends) {
    line("ks::blend(" + result + ", " + text + ", " + mask_ + ");");
  } else {
    line(result + " = " + text + ";");
  }
}

void WideEmitter::statement(const Stmt& stmt) {
  if (stmt.kind != StmtKind::kBlock) out_.begin_statement(stmt);
  switch (stmt.kind) {
    case StmtKind::kBlock:
      return scope(stmt.body);
    case StmtKind::kDeclare:
      return declare(stmt);
    case StmtKind::kAssign:
      return assign(stmt);
    case StmtKind::kStore:
    case StmtKind::kStoreElement:
      return store(stmt);
    case StmtKind::kTypedStore:
      return typed_store(stmt);
    case StmtKind::kAtomic:
      return atomic(stmt);
    case StmtKind::kCall:
      return call_function(stmt, false);
    case StmtKind::kTraceRay:
      return trace_ray(stmt);
    case StmtKind::kWave:
      return wave(stmt);
    case StmtKind::kDiscard:  // the assignment before it is enough
      return;
    case StmtKind::kIf:
      return if_(stmt);
    case StmtKind::kLoop:
      return loop(stmt);
    case StmtKind::kSwitch:
      return switch_(stmt);
    case StmtKind::kBreak:
      return facts(stmt).masked ? masked_jump(stmt) : line("break;");
    case StmtKind::kContinue:
      if (facts(stmt).masked) return masked_jump(stmt);
      out_.used_labels_.insert(loops_.back());
      return line("goto continue_" + std::to_string(loops_.back()) + ";");
    case StmtKind::kReturn:
      return facts(stmt).masked ? masked_jump(stmt) : return_(stmt);
    default:
      break;  // rejected by the plan
  }
}

}  // namespace kaamos::hlsl
