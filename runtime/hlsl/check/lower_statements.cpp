// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "runtime/hlsl/check/checker.h"

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

}  // namespace

// Whether the end of the block is unreachable.
bool Lowerer::ends(const ir::Block& body) {
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

void Lowerer::lower_block(std::span<const Stmt* const> statements) {
  for (const Stmt* statement : statements) lower_statement(statement);
}

void Lowerer::lower_body(const Stmt* statement, ir::Block& target) {
  ir::Block* outer = block_;
  Scope* scope = scope_;
  block_ = &target;
  scope_ = checker_.make_scope(ScopeKind::kBlock, scope);
  if (const auto* inner = as<BlockStmt>(statement)) {
    lower_block(inner->statements);
  } else {
    lower_statement(statement);
  }
  scope_ = scope;
  block_ = outer;
}

void Lowerer::lower_discarded(const Expr* expression) {
  const bool unused = result_unused_;
  result_unused_ = true;
  lower(expression);
  result_unused_ = unused;
}

// Before HLSL 2021 the variables of a `for` belong to the scope around it.
void Lowerer::lower_loop_head(const Stmt* init) {
  if (!init) return;
  lower_statement(init);
  const auto* declared = as<DeclStmt>(init);
  if (!declared) return;
  for (const Decl* decl : declared->declarations) {
    const Symbol* symbol = checker_.find_local(scope_, decl->name);
    if (symbol && symbol->kind == SymbolKind::kVariable) symbol->variable->is_loop_variable = true;
  }
}

void Lowerer::lower_statement(const Stmt* statement) {
  if (depth_ >= 400) {
    report(CheckId::kTooDeep, statement->location, {"400"});
    return;
  }
  ++depth_;
  at(statement->location);
  switch (statement->kind) {
    case StmtKind::kError:
    case StmtKind::kEmpty:
      break;
    case StmtKind::kBlock: {
      ir::Stmt* node = build_.stmt(ir::StmtKind::kBlock);
      lower_body(statement, node->body);
      emit(node);
      break;
    }
    case StmtKind::kDecl:
      for (const Decl* decl : static_cast<const DeclStmt*>(statement)->declarations) {
        if (const auto* variable = as<VariableDecl>(decl)) {
          lower_local(variable);
        } else {
          checker_.declare(decl, scope_);
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
      if (checker_.options_->hlsl_version < 2021) {
        lower_loop_head(loop->init);
        lower_loop(loop->condition, loop->step, loop->body, false, *loop);
        break;
      }
      Scope* scope = scope_;
      ir::Block* outer = block_;
      ir::Stmt* node = build_.stmt(ir::StmtKind::kBlock);
      scope_ = checker_.make_scope(ScopeKind::kBlock, scope);
      block_ = &node->body;
      if (loop->init) lower_statement(loop->init);
      lower_loop(loop->condition, loop->step, loop->body, false, *loop);
      block_ = outer;
      scope_ = scope;
      emit(node);
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
      if (loop_depth_ == 0 && switch_depth_ == 0) {
        report(CheckId::kStrayJump, statement->location, {"break", "a loop or a switch"});
      } else {
        emit(build_.stmt(ir::StmtKind::kBreak));
      }
      break;
    case StmtKind::kContinue:
      if (loop_depth_ == 0) {
        report(CheckId::kStrayJump, statement->location, {"continue", "a loop"});
      } else {
        emit(build_.stmt(ir::StmtKind::kContinue));
      }
      break;
    case StmtKind::kReturn:
      lower_return(static_cast<const ReturnStmt*>(statement));
      break;
    case StmtKind::kDiscard:
      use_in_stages("discard", ir::kStagePixel, statement->location);
      emit(build_.stmt(ir::StmtKind::kDiscard));
      break;
  }
  --depth_;
}

const ir::Expr* Lowerer::initial_value(const Expr* initialiser, const Type* type) {
  Value value = lower(initialiser);
  return convert(value, type, initialiser->location);
}

// Whether it is a temporary that nothing else reads, so that the variable it initialises can take
// its place.
bool Lowerer::is_result_of_last_call(const ir::Expr* value) const {
  return value && value->kind == ir::ExprKind::kVariable && value->variable == call_result_ &&
         !block_->empty() && block_->back()->kind == ir::StmtKind::kCall &&
         block_->back()->result == call_result_;
}

void Lowerer::declare_variable(VariableInfo* info) {
  info->variable = build_.variable(std::string(info->name), info->type->ir, ir::Storage::kLocal);
  info->variable->is_const = info->is_const;
}

void Lowerer::lower_local(const VariableDecl* decl) {
  const Type* type = checker_.resolve_variable_type(decl, scope_);
  at(decl->location);
  VariableInfo* info = &checker_.variables_.emplace_back();
  info->name = decl->name;
  info->type = types_.error();
  info->is_const = checker_.is_const_type(decl->type);
  const bool valid = checker_.check_variable_type(type, decl->location, decl->name);
  if (const Symbol* before = checker_.find_taken(scope_, decl->name)) {
    // [HLSL 2018: the variables of a loop belong to the scope around it]
    const bool hides = before->kind == SymbolKind::kVariable && before->variable->is_loop_variable;
    report(hides ? CheckId::kLoopVariableAgain : CheckId::kRedefinition, decl->location,
           {std::string(decl->name)});
    if (!hides) return;
    scope_->symbols.erase(decl->name);
  }
  if (decl->modifiers & kModGroupshared) {
    report(CheckId::kLocalGroupshared, decl->location, {std::string(decl->name)});
    checker_.add_symbol(scope_, SymbolKind::kVariable, decl->name, decl->location)->variable = info;
    return;
  }
  if (valid && type->is_query()) {
    lower_local_query(decl, type, info);
    checker_.add_symbol(scope_, SymbolKind::kVariable, decl->name, decl->location)->variable = info;
    return;
  }
  if (decl->modifiers & kModStatic) {
    if (valid) lower_local_static(decl, type);
    return;
  }
  const ir::Expr* value = nullptr;
  const bool is_sized_by_value = valid && type->is_array() && type->count == 0;
  if (is_sized_by_value) {
    const auto* list = as<InitListExpr>(decl->initializer);
    if (!list) {
      report(CheckId::kUnboundedVariable, decl->location, {std::string(decl->name)});
      checker_.add_symbol(scope_, SymbolKind::kVariable, decl->name, decl->location)->variable =
          info;
      return;
    }
    std::vector<Piece> pieces;
    collect_pieces(list, pieces, 0);
    uint64_t count = 0;
    for (const Piece& piece : pieces) count += flat_component_count(piece.type);
    const uint64_t element = std::max<uint64_t>(1, flat_component_count(type->element));
    type = types_.array(type->element,
                        static_cast<uint32_t>(std::clamp<uint64_t>(count / element, 1, 1u << 20)));
    value = build_from_pieces(type, std::move(pieces), decl->initializer->location, false);
  }
  if (valid) info->type = type;
  // The scope of a name begins before its initialiser, as in C: `int x = x;` means the new x, which
  // is zero there.
  checker_.add_symbol(scope_, SymbolKind::kVariable, decl->name, decl->location)->variable = info;
  const size_t before = block_->size();
  if (valid && decl->initializer && !is_sized_by_value) {
    value = initial_value(decl->initializer, type);
  } else if (decl->initializer && !is_sized_by_value) {
    lower(decl->initializer);
  } else if (valid && !decl->initializer && info->is_const) {
    report(CheckId::kConstWithoutValue, decl->location, {std::string(decl->name)});
    if (!contains_resource(type)) value = build_.zero(type->ir);
  }
  if (!valid) return;
  at(decl->location);
  const bool uses_itself = info->variable;
  if (uses_itself) {
    report(CheckId::kOwnInitialiser, decl->location, {std::string(decl->name)});
    ir::Stmt* node = build_.stmt(ir::StmtKind::kDeclare);
    node->variable = info->variable;
    info->variable->is_const = false;
    block_->insert(block_->begin() + static_cast<ptrdiff_t>(before), node);
    if (value) assign(info->variable, value);
  } else if (is_result_of_last_call(value)) {
    info->variable = call_result_;
    info->variable->name = decl->name;
    info->variable->is_const = info->is_const;
    call_result_ = nullptr;  // now owned by the variable
  } else {
    declare_variable(info);
    ir::Stmt* node = build_.stmt(ir::StmtKind::kDeclare);
    node->variable = info->variable;
    node->value = value;
    emit(node);
  }
  // `const uint n = 4; float a[n];`
  const bool is_known = info->is_const && !uses_itself && value &&
                        type->ir->kind == ir::TypeKind::kScalar &&
                        value->kind == ir::ExprKind::kLiteral;
  if (is_known) info->constant = value;
}

// There is one per shader invocation, as if it were declared globally. Its initialiser must not use
// locals.
void Lowerer::lower_local_static(const VariableDecl* decl, const Type* type) {
  checker_.declare_static(decl, type, scope_);
  Symbol* symbol = checker_.find_local(scope_, decl->name);
  if (!symbol || !symbol->variable) return;
  if (symbol->variable->variable) symbol->variable->variable->name = decl->name;
  symbol->variable->sequence = checker_.visible_;
  checker_.initialise(symbol->variable);
  const ir::Variable* variable = symbol->variable->variable;
  if (!symbol->variable->start_up.empty()) {
    report(CheckId::kUnsupported, decl->location,
           {"the initialiser of a local static variable that calls a function"});
  } else if (variable && variable->initialiser) {
    const std::function<bool(const ir::Expr*)> uses_local = [&](const ir::Expr* expr) {
      if (expr->kind == ir::ExprKind::kVariable &&
          (expr->variable->storage == ir::Storage::kLocal ||
           expr->variable->storage == ir::Storage::kParameter)) {
        return true;
      }
      return std::any_of(expr->operands.begin(), expr->operands.end(), uses_local);
    };
    if (uses_local(variable->initialiser)) {
      report(CheckId::kStaticUsesLocal, decl->location, {std::string(decl->name)});
    }
  }
}

void Lowerer::lower_if(const IfStmt* statement) {
  const Value condition = lower(statement->condition);
  const ir::Expr* value = as_condition(condition, statement->condition->location);
  at(statement->location);
  ir::Stmt* node = build_.stmt(ir::StmtKind::kIf);
  node->value = value ? value : build_.boolean(false);
  lower_body(statement->then_branch, node->body);
  if (statement->else_branch) lower_body(statement->else_branch, node->orelse);
  emit(node);
}

// Only a hint: an argument that is not a number is ignored.
uint32_t Lowerer::unroll_count(const Stmt& loop) {
  constexpr uint32_t kMost = 16;
  const Attribute* attribute = find_attribute(loop.attributes, "unroll");
  if (attribute == nullptr) return 0;
  if (attribute->arguments.empty()) return kMost;
  const auto* count = as<IntLiteralExpr>(attribute->arguments[0]);
  return count != nullptr ? static_cast<uint32_t>(std::min<uint64_t>(count->value, kMost)) : 0;
}

void Lowerer::lower_loop(const Expr* condition, const Expr* step, const Stmt* body,
                         bool test_at_end, const Stmt& statement) {
  at(statement.location);
  ir::Stmt* node = build_.stmt(ir::StmtKind::kLoop);
  node->test_at_end = test_at_end;
  node->unroll = unroll_count(statement);
  ir::Block* outer = block_;
  const auto lower_condition = [&] {
    if (!condition) return;
    block_ = &node->prelude;
    const Value value = lower(condition);
    const ir::Expr* test = as_condition(value, condition->location);
    node->value = test ? test : build_.boolean(false);
    if (test && test->kind == ir::ExprKind::kLiteral && test->literal[0] && node->prelude.empty()) {
      node->value = nullptr;
    }
    block_ = outer;
  };
  if (!test_at_end) lower_condition();
  ++loop_depth_;
  const int switches = switch_depth_;
  switch_depth_ = 0;
  lower_body(body, node->body);
  switch_depth_ = switches;
  --loop_depth_;
  if (step) {
    block_ = &node->step;
    lower_discarded(step);
    block_ = outer;
  }
  if (test_at_end) lower_condition();
  emit(node);
}

void Lowerer::lower_switch(const SwitchStmt* statement) {
  Value selector = lower(statement->condition);
  selector = settle(selector);
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
      const ir::Expr* value = load(selector);
      node->value = value ? build_.convert(value, plain_scalar(type->scalar)) : nullptr;
    }
  }
  if (!node->value) node->value = build_.int32(0);
  Scope* scope = scope_;
  ir::Block* outer = block_;
  scope_ = checker_.make_scope(ScopeKind::kBlock, scope);
  ++switch_depth_;
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
      const auto value = checker_.constant_integer(label.value, scope_, "a case label");
      if (!value) continue;
      const int64_t number = static_cast<int64_t>(
          convert_bits(static_cast<uint64_t>(*value), Scalar::kInt64, plain_scalar(type->scalar)));
      if (!seen.insert(number).second) {
        report(CheckId::kDuplicateCase, label.location, {std::to_string(number)});
        continue;
      }
      one.labels.push_back(number);
    }
    block_ = &one.body;
    lower_block(section.statements);
    block_ = outer;
    node->cases.push_back(std::move(one));
  }
  --switch_depth_;
  scope_ = scope;
  share_section_variables(node);
  emit(node);
}

// All sections of a switch share one scope: what a later one uses is declared before the switch.
void Lowerer::share_section_variables(ir::Stmt* node) {
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
      emit(front);
      ir::Stmt* assignment = build_.stmt(ir::StmtKind::kAssign);
      assignment->location = statement->location;
      assignment->place = build_.read(variable);
      assignment->value = statement->value ? statement->value : build_.zero(variable->type);
      statement = assignment;
    }
  }
}

void Lowerer::lower_return(const ReturnStmt* statement) {
  const Type* result = function_ && function_->result ? function_->result : types_.void_type();
  const ir::Expr* value = nullptr;
  if (statement->value) {
    Value given = lower(statement->value);
    if (result->is_void()) {
      const bool is_void = !given.failed() && given.type && given.type->is_void();
      if (!given.failed() && !is_void) report(CheckId::kReturnsValue, statement->location);
    } else {
      value = convert(given, result, statement->value->location);
      if (!value) value = build_.zero(result->ir);
    }
  } else if (!result->is_void()) {
    report(CheckId::kReturnsNothing, statement->location, {to_string(result)});
    value = build_.zero(result->ir);
  }
  at(statement->location);
  ir::Stmt* node = build_.stmt(ir::StmtKind::kReturn);
  node->value = value;
  emit(node);
}

}  // namespace kaamos::hlsl
