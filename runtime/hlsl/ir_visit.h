// SPDX-License-Identifier: MIT
//
// Walks over statements and expressions, for whoever asks what a function refers to.
#pragma once

#include "runtime/hlsl/ir.h"

namespace kaamos::hlsl::ir {

// What a statement refers to, whatever its kind.
template <typename ExprVisitor, typename StmtVisitor>
void visit(const Stmt& stmt, const ExprVisitor& on_expr, const StmtVisitor& on_stmt);

template <typename ExprVisitor, typename StmtVisitor>
void visit(const Block& block, const ExprVisitor& on_expr, const StmtVisitor& on_stmt) {
  for (const Stmt* stmt : block) {
    visit(*stmt, on_expr, on_stmt);
  }
}

template <typename ExprVisitor>
void visit_expr(const Expr* expr, const ExprVisitor& on_expr) {
  if (expr == nullptr) {
    return;
  }
  on_expr(*expr);
  for (const Expr* operand : expr->operands) {
    visit_expr(operand, on_expr);
  }
}

template <typename ExprVisitor, typename StmtVisitor>
void visit(const Stmt& stmt, const ExprVisitor& on_expr, const StmtVisitor& on_stmt) {
  on_stmt(stmt);
  for (const Expr* expr : {stmt.place, stmt.value, stmt.compare}) {
    visit_expr(expr, on_expr);
  }
  for (const auto* list : {&stmt.operands, &stmt.arguments}) {
    for (const Expr* expr : *list) {
      visit_expr(expr, on_expr);
    }
  }
  for (const Block* block : {&stmt.prelude, &stmt.body, &stmt.orelse, &stmt.step}) {
    visit(*block, on_expr, on_stmt);
  }
  for (const SwitchCase& c : stmt.cases) {
    visit(c.body, on_expr, on_stmt);
  }
}

}  // namespace kaamos::hlsl::ir
