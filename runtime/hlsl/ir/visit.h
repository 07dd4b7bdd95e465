// SPDX-License-Identifier: MIT
//
// Visits everything that a statement or a block refers to, whatever its kind.
#pragma once

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl::ir {

// Calls on_expr(const Expr&) for the expression and all its operands; null is ignored.
template <typename ExprVisitor>
void visit_expr(const Expr* expr, const ExprVisitor& on_expr) {
  if (expr == nullptr) return;
  on_expr(*expr);
  for (const Expr* operand : expr->operands) visit_expr(operand, on_expr);
}

// Calls on_expr for each expression of the statement itself, but not of the statements inside it.
template <typename ExprVisitor>
void visit_own_expressions(const Stmt& stmt, const ExprVisitor& on_expr) {
  for (const Expr* expr : {stmt.place, stmt.value, stmt.compare}) visit_expr(expr, on_expr);
  for (const auto* list : {&stmt.operands, &stmt.arguments}) {
    for (const Expr* expr : *list) visit_expr(expr, on_expr);
  }
}

template <typename ExprVisitor, typename StmtVisitor>
void visit(const Block& block, const ExprVisitor& on_expr, const StmtVisitor& on_stmt);

// on_stmt(const Stmt&) is called before anything inside the statement is visited.
template <typename ExprVisitor, typename StmtVisitor>
void visit(const Stmt& stmt, const ExprVisitor& on_expr, const StmtVisitor& on_stmt) {
  on_stmt(stmt);
  visit_own_expressions(stmt, on_expr);
  for (const Block* block : {&stmt.prelude, &stmt.body, &stmt.orelse, &stmt.step}) {
    visit(*block, on_expr, on_stmt);
  }
  for (const SwitchCase& c : stmt.cases) visit(c.body, on_expr, on_stmt);
}

template <typename ExprVisitor, typename StmtVisitor>
void visit(const Block& block, const ExprVisitor& on_expr, const StmtVisitor& on_stmt) {
  for (const Stmt* stmt : block) visit(*stmt, on_expr, on_stmt);
}

// Returns whether it is the number, written out.
inline bool is_literal(const Expr* expr, uint32_t number) {
  return expr->kind == ExprKind::kLiteral && static_cast<uint32_t>(expr->literal[0]) == number;
}

// Returns whether it is where the positions and the cluster of a hit are.
inline bool is_position_table(const Expr& expr) {
  return (expr.kind == ExprKind::kSystemValue &&
          expr.system_value == SystemValue::kPositionTable) ||
         (expr.kind == ExprKind::kQueryValue && expr.query_value == QueryValue::kPositionTable);
}

// The variable that a place is part of.
inline const Variable* root_of(const Expr* place) {
  while (place != nullptr && place->kind != ExprKind::kVariable) {
    place = place->operands.empty() ? nullptr : place->operands[0];
  }
  return place != nullptr ? place->variable : nullptr;
}

// Returns whether a function can change an argument other than through its by-reference parameter:
// if the argument uses globals, the function can name them itself.
inline bool callee_can_write(const Expr* argument) {
  bool names_global = false;
  visit_expr(argument, [&](const Expr& expr) {
    names_global = names_global || (expr.kind == ExprKind::kVariable &&
                                    (expr.variable->storage == Storage::kStaticGlobal ||
                                     expr.variable->storage == Storage::kGroupShared));
  });
  return names_global;
}

// Calls on_variable(const Variable*, const Expr* value) for each variable that the statement itself
// writes. `value` is the statement's own `value` if the whole variable is assigned, else null
// (results, references, parts of a variable).
template <typename VariableVisitor>
void visit_written(const Stmt& stmt, const VariableVisitor& on_variable) {
  switch (stmt.kind) {
    case StmtKind::kDeclare:
      on_variable(stmt.variable, stmt.value);
      return;
    case StmtKind::kAssign:
      on_variable(root_of(stmt.place),
                  stmt.place->kind == ExprKind::kVariable ? stmt.value : nullptr);
      return;
    case StmtKind::kCall:
      for (size_t i = 0; i < stmt.arguments.size(); ++i) {
        if (stmt.function->parameters[i]->mode == ParameterMode::kIn) continue;
        on_variable(root_of(stmt.arguments[i]), nullptr);
      }
      break;
    case StmtKind::kAtomic:
    case StmtKind::kQuery:
    case StmtKind::kTraceRay:
    case StmtKind::kInvoke:
    case StmtKind::kCallShader:
      if (stmt.place != nullptr) on_variable(root_of(stmt.place), nullptr);
      break;
    default:
      break;
  }
  if (stmt.result != nullptr) on_variable(stmt.result, nullptr);
}

}  // namespace kaamos::hlsl::ir
