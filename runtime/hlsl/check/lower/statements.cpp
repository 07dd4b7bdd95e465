// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/statements.h"

#include <algorithm>
#include <functional>
#include <set>

#include "runtime/hlsl/builder/constants.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/attributes.h"

namespace kaamos::hlsl {
namespace {

bool uses_variable(const ir::Expr* expr, const ir::Variable* variable) {
  if (!expr) return false;
  return expr->variable == variable ||
         std::any_of(expr->operands.begin(), expr->operands.end(),
                     [&](const ir::Expr* operand) { return uses_variable(operand, variable); });
}

bool uses_variable(const ir::Block& body, const ir::Variable* variable) {
  return std::any_of(body.begin(), body.end(), [&](const ir::Stmt* statement) {
    const auto in_list = [&](const std::vector<const ir::Expr*>& list) {
      return std::any_of(list.begin(), list.end(),
                         [&](const ir::Expr* expr) { return uses_variable(expr, variable); });
    };
    return statement->result == variable || uses_variable(statement->place, variable) ||
           uses_variable(statement->value, variable) ||
           uses_variable(statement->compare, variable) || in_list(statement->operands) ||
           in_list(statement->arguments) || uses_variable(statement->prelude, variable) ||
           uses_variable(statement->body, variable) || uses_variable(statement->orelse, variable) ||
           uses_variable(statement->step, variable) ||
           std::any_of(
               statement->cases.begin(), statement->cases.end(),
               [&](const ir::SwitchCase& one) { return uses_variable(one.body, variable); });
  });
}

// The C++ compiler is asked to repeat a body this often at most.
constexpr uint32_t kMostRepeated = 16;

}  // namespace

// Returns whether the end of the block is unreachable.
bool Statements::ends(const ir::Block& body) {
  if (body.empty()) return false;
  const ir::Stmt* last = body.back();
  switch (last->kind) {
    case ir::StmtKind::kReturn:
    case ir::StmtKind::kIgnoreHit:
    case ir::StmtKind::kAcceptHitAndEndSearch:
    case ir::StmtKind::kBreak:
    case ir::StmtKind::kContinue:
      return true;
    case ir::StmtKind::kBlock:
      return ends(last->body);
    case ir::StmtKind::kIf:
      return ends(last->body) && ends(last->orelse);
    case ir::StmtKind::kLoop: {
      if (last->value) return false;
      // A loop without a condition ends only by its own break.
      const std::function<bool(const ir::Block&)> breaks = [&](const ir::Block& statements) {
        return std::any_of(statements.begin(), statements.end(), [&](const ir::Stmt* statement) {
          if (statement->kind == ir::StmtKind::kBreak) return true;
          if (statement->kind == ir::StmtKind::kLoop || statement->kind == ir::StmtKind::kSwitch) {
            return false;
          }
          return breaks(statement->body) || breaks(statement->orelse);
        });
      };
      return !breaks(last->body);
    }
    case ir::StmtKind::kSwitch: {
      bool has_default = false;
      const std::function<bool(const ir::Block&)> breaks = [&](const ir::Block& statements) {
        return std::any_of(statements.begin(), statements.end(), [&](const ir::Stmt* statement) {
          if (statement->kind == ir::StmtKind::kBreak) return true;
          if (statement->kind == ir::StmtKind::kLoop || statement->kind == ir::StmtKind::kSwitch) {
            return false;
          }
          return breaks(statement->body) || breaks(statement->orelse);
        });
      };
      for (const ir::SwitchCase& one : last->cases) {
        has_default = has_default || one.is_default;
        if (breaks(one.body)) return false;
      }
      return has_default && !last->cases.empty() && ends(last->cases.back().body);
    }
    default:
      return false;
  }
}

void Statements::lower_block(std::span<const Stmt* const> statements) {
  for (const Stmt* statement : statements) lower_statement(statement);
}

void Statements::lower_body(const Stmt* statement, ir::Block& target) {
  ir::Block* outer = body_.block;
  Scope* scope = body_.scope;
  body_.block = &target;
  body_.scope = names_.make_block_scope(scope);
  if (const auto* inner = as<BlockStmt>(statement)) {
    lower_block(inner->statements);
  } else {
    lower_statement(statement);
  }
  body_.scope = scope;
  body_.block = outer;
}

void Statements::lower_discarded(const Expr* expression) {
  const bool unused = body_.result_unused;
  body_.result_unused = true;
  lower_.expressions.lower(expression);
  body_.result_unused = unused;
}

// Before HLSL 2021 the variables of a `for` belong to the scope around it.
void Statements::lower_loop_head(const Stmt* init) {
  if (!init) return;
  lower_statement(init);
  const auto* declared = as<DeclStmt>(init);
  if (!declared) return;
  for (const Decl* decl : declared->declarations) {
    const Symbol* symbol = names_.find_local(body_.scope, decl->name);
    if (symbol && symbol->kind == SymbolKind::kVariable) symbol->variable->is_loop_variable = true;
  }
}

void Statements::lower_statement(const Stmt* statement) {
  if (bench_.depth >= 400) {
    report(CheckId::kTooDeep, statement->location, {"400"});
    return;
  }
  ++bench_.depth;
  at(statement->location);
  lower_.coverage.statement(*statement);
  switch (statement->kind) {
    case StmtKind::kError:
    case StmtKind::kEmpty:
      break;
    case StmtKind::kBlock: {
      ir::Stmt* node = build_.stmt(ir::StmtKind::kBlock);
      lower_body(statement, node->body);
      body_.emit(node);
      break;
    }
    case StmtKind::kDecl:
      for (const Decl* decl : static_cast<const DeclStmt*>(statement)->declarations) {
        if (const auto* variable = as<VariableDecl>(decl)) {
          lower_.locals.lower_local(variable);
        } else {
          names_.declare(decl, body_.scope);
        }
      }
      break;
    case StmtKind::kExpr:
      lower_discarded(static_cast<const ExprStmt*>(statement)->expression);
      break;
    case StmtKind::kIf:
      lower_if(static_cast<const IfStmt*>(statement));
      break;
    case StmtKind::kFor: {
      const auto* loop = static_cast<const ForStmt*>(statement);
      if (names_.options().hlsl_version < 2021) {
        lower_loop_head(loop->init);
        lower_loop(loop->condition, loop->step, loop->body, false, *loop);
        break;
      }
      Scope* scope = body_.scope;
      ir::Block* outer = body_.block;
      ir::Stmt* node = build_.stmt(ir::StmtKind::kBlock);
      body_.scope = names_.make_block_scope(scope);
      body_.block = &node->body;
      if (loop->init) lower_statement(loop->init);
      lower_loop(loop->condition, loop->step, loop->body, false, *loop);
      body_.block = outer;
      body_.scope = scope;
      body_.emit(node);
      break;
    }
    case StmtKind::kWhile: {
      const auto* loop = static_cast<const WhileStmt*>(statement);
      lower_loop(loop->condition, nullptr, loop->body, false, *loop);
      break;
    }
    case StmtKind::kDo: {
      const auto* loop = static_cast<const DoStmt*>(statement);
      lower_loop(loop->condition, nullptr, loop->body, true, *loop);
      break;
    }
    case StmtKind::kSwitch:
      lower_switch(static_cast<const SwitchStmt*>(statement));
      break;
    case StmtKind::kBreak:
      if (body_.loop_depth == 0 && body_.switch_depth == 0) {
        report(CheckId::kStrayJump, statement->location, {"break", "a loop or a switch"});
      } else {
        body_.emit(build_.stmt(ir::StmtKind::kBreak));
      }
      break;
    case StmtKind::kContinue:
      if (body_.loop_depth == 0) {
        report(CheckId::kStrayJump, statement->location, {"continue", "a loop"});
      } else {
        body_.emit(build_.stmt(ir::StmtKind::kContinue));
      }
      break;
    case StmtKind::kReturn:
      lower_return(static_cast<const ReturnStmt*>(statement));
      break;
    case StmtKind::kDiscard:
      lower_.intrinsics.use_in_stages("discard", ir::kStagePixel, statement->location);
      body_.emit(build_.stmt(ir::StmtKind::kDiscard));
      break;
  }
  --bench_.depth;
}

void Statements::lower_if(const IfStmt* statement) {
  const Value condition = lower_.expressions.lower(statement->condition);
  const ir::Expr* value =
      lower_.conversions.as_condition(condition, statement->condition->location);
  at(statement->location);
  ir::Stmt* node = build_.stmt(ir::StmtKind::kIf);
  node->value = value ? value : build_.boolean(false);
  const auto known = evaluate(node->value);
  const int dead = body_.dead_depth;
  if (known && !(*known)[0]) ++body_.dead_depth;
  if (!known) lower_.coverage.arms(node->body, node->orelse, statement->location);
  lower_body(statement->then_branch, node->body);
  body_.dead_depth = dead + (known && (*known)[0] ? 1 : 0);
  if (statement->else_branch) lower_body(statement->else_branch, node->orelse);
  body_.dead_depth = dead;
  body_.emit(node);
}

// The argument of [unroll(N)]; nothing without one, or if it is 0.
std::optional<uint32_t> Statements::most_turns(const Stmt& loop) {
  const Attribute* attribute = find_attribute(loop.attributes, "unroll");
  if (attribute == nullptr || attribute->arguments.empty()) return std::nullopt;
  constexpr std::string_view kWhat = "the count of [unroll], 0 or more,";
  const Expr* argument = attribute->arguments[0];
  const auto count = lower_.constant_integer(argument, body_.scope, kWhat);
  if (count && *count < 0) report(CheckId::kNotConstant, argument->location, {std::string(kWhat)});
  if (!count || *count <= 0) return std::nullopt;
  return static_cast<uint32_t>(std::min<int64_t>(*count, UINT32_MAX));
}

void Statements::lower_loop(const Expr* condition, const Expr* step, const Stmt* body,
                            bool test_at_end, const Stmt& statement) {
  at(statement.location);
  if (find_attribute(statement.attributes, "loop") &&
      find_attribute(statement.attributes, "unroll")) {
    report(CheckId::kLoopAttributes, statement.location, {"loop", "unroll"});
  }
  ir::Stmt* node = build_.stmt(ir::StmtKind::kLoop);
  node->test_at_end = test_at_end;
  ir::Block* outer = body_.block;
  // [unroll(N)] ends a loop after N turns, as in DXC, which repeats the body N times and leaves no
  // loop behind. The condition is evaluated after the last of them, too.
  const std::optional<uint32_t> most = most_turns(statement);
  const ir::Variable* turns = most ? body_.temporary(build_.uint32(0)) : nullptr;
  if (find_attribute(statement.attributes, "unroll")) {
    node->unroll = std::min(most.value_or(kMostRepeated), kMostRepeated);
  }
  const auto lower_condition = [&] {
    if (!condition) return;
    body_.block = &node->prelude;
    const Value value = lower_.expressions.lower(condition);
    const ir::Expr* test = lower_.conversions.as_condition(value, condition->location);
    node->value = test ? test : build_.boolean(false);
    if (test && test->kind == ir::ExprKind::kLiteral && test->literal[0] && node->prelude.empty()) {
      node->value = nullptr;
    }
    body_.block = outer;
  };
  if (!test_at_end) lower_condition();
  ++body_.loop_depth;
  const int switches = body_.switch_depth;
  body_.switch_depth = 0;
  lower_body(body, node->body);
  body_.switch_depth = switches;
  --body_.loop_depth;
  if (step) {
    body_.block = &node->step;
    lower_discarded(step);
    body_.block = outer;
  }
  if (test_at_end) lower_condition();
  if (turns) {
    at(statement.location);
    const ir::Expr* turn = build_.read(turns);
    body_.block = &node->step;
    body_.assign(turns, build_.add(turn, 1));
    body_.block = outer;
    const ir::Expr* left = build_.binary(ir::BinaryOp::kLess, turn, build_.uint32(*most));
    node->value = node->value ? build_.binary(ir::BinaryOp::kBitAnd, node->value, left) : left;
  } else {
    lower_.body_rules.check_loop(*node, statement.location);
  }
  const Attribute* unroll = find_attribute(statement.attributes, "unroll");
  if (unroll && unroll->arguments.empty()) {
    lower_.body_rules.check_unroll(*node, unroll->location);
  }
  lower_.coverage.loop(*node, statement.location);
  body_.emit(node);
}

void Statements::lower_switch(const SwitchStmt* statement) {
  if (statement->sections.empty()) report(CheckId::kEmptySwitch, statement->location);
  Value selector = lower_.expressions.lower(statement->condition);
  selector = lower_.conversions.settle(selector);
  at(statement->location);
  ir::Stmt* node = build_.stmt(ir::StmtKind::kSwitch);
  const Type* type = types_.scalar(Scalar::kInt32);
  if (!selector.failed()) {
    const bool integer =
        selector.type && (selector.type->is_enum() ||
                          (selector.type->is_scalar() && !is_floating(selector.type->scalar)));
    if (!integer) {
      report(CheckId::kSwitchType, statement->condition->location,
             {selector.type ? to_string(selector.type) : "a resource"});
    } else {
      type = types_.scalar(selector.type->scalar == Scalar::kBool ? Scalar::kInt32
                                                                  : selector.type->scalar);
      const ir::Expr* value = lower_.places.load(selector);
      node->value = value ? build_.convert(value, plain_scalar(type->scalar)) : nullptr;
    }
  }
  if (!node->value) node->value = build_.int32(0);
  Scope* scope = body_.scope;
  ir::Block* outer = body_.block;
  body_.scope = names_.make_block_scope(scope);
  ++body_.switch_depth;
  std::set<int64_t> seen;
  bool has_default = false;
  for (const SwitchSection& section : statement->sections) {
    ir::SwitchCase one;
    for (const CaseLabel& label : section.labels) {
      if (!label.value) {
        if (has_default) report(CheckId::kDuplicateCase, label.location, {"default"});
        has_default = one.is_default = true;
        continue;
      }
      const auto value = lower_.constant_integer(label.value, body_.scope, "a case label");
      if (!value) continue;
      const int64_t number = static_cast<int64_t>(
          convert_bits(static_cast<uint64_t>(*value), Scalar::kInt64, plain_scalar(type->scalar)));
      if (!seen.insert(number).second) {
        report(CheckId::kDuplicateCase, label.location, {std::to_string(number)});
        continue;
      }
      one.labels.push_back(number);
    }
    body_.block = &one.body;
    lower_.coverage.section(*node, statement->location);
    lower_block(section.statements);
    body_.block = outer;
    node->cases.push_back(std::move(one));
  }
  if (!has_default) lower_.coverage.no_section(*node, statement->location);
  --body_.switch_depth;
  body_.scope = scope;
  share_section_variables(node);
  body_.emit(node);
}

// All sections of a switch share one scope: what a later one uses is declared before the switch.
void Statements::share_section_variables(ir::Stmt* node) {
  for (size_t i = 0; i + 1 < node->cases.size(); ++i) {
    for (const ir::Stmt*& statement : node->cases[i].body) {
      if (statement->kind != ir::StmtKind::kDeclare || statement->variable->name.empty()) continue;
      const ir::Variable* variable = statement->variable;
      const bool is_shared = std::any_of(
          node->cases.begin() + static_cast<ptrdiff_t>(i) + 1, node->cases.end(),
          [&](const ir::SwitchCase& later) { return uses_variable(later.body, variable); });
      if (!is_shared) continue;
      ir::Stmt* front = build_.stmt(ir::StmtKind::kDeclare);
      front->variable = variable;
      body_.emit(front);
      ir::Stmt* assignment = build_.stmt(ir::StmtKind::kAssign);
      assignment->location = statement->location;
      assignment->place = build_.read(variable);
      assignment->value = statement->value ? statement->value : build_.zero(variable->type);
      statement = assignment;
    }
  }
}

void Statements::lower_return(const ReturnStmt* statement) {
  const Type* result =
      body_.function && body_.function->result ? body_.function->result : types_.void_type();
  const ir::Expr* value = nullptr;
  if (statement->value) {
    if (statement->value->kind == ExprKind::kThis) {
      report(CheckId::kReturnsThis, statement->value->location);
    }
    Value given = lower_.expressions.lower(statement->value);
    if (result->is_query()) {
      given.location = statement->value->location;
      lower_.ray_queries.return_query(given, statement->value->location);
    } else if (result->is_void()) {
      const bool is_void = !given.failed() && given.type && given.type->is_void();
      if (!given.failed() && !is_void) report(CheckId::kReturnsValue, statement->location);
    } else {
      value = lower_.conversions.convert(given, result, statement->value->location);
      if (!value) value = build_.zero(result->ir);
    }
  } else if (!result->is_void()) {
    report(CheckId::kReturnsNothing, statement->location, {to_string(result)});
    if (!result->is_query()) value = build_.zero(result->ir);
  }
  at(statement->location);
  ir::Stmt* node = build_.stmt(ir::StmtKind::kReturn);
  node->value = value;
  body_.emit(node);
}

}  // namespace kaamos::hlsl
