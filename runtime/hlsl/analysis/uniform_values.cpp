// SPDX-License-Identifier: MIT
#include "runtime/hlsl/analysis/uniform_values.h"

#include <algorithm>

#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

bool is_constant_buffer(const Expr* resource) {
  return resource->type->resource == ResourceKind::kConstantBuffer;
}

}  // namespace

UniformValues::UniformValues(const EntryPoint& entry, const std::vector<Region>& regions) {
  parameters_.insert(entry.function->parameters.begin(), entry.function->parameters.end());
  for (size_t i = 0; i < entry.parameters.size(); ++i) {
    if (entry.parameters[i] == EntryParameter::kGroupId) {
      variables_.insert(entry.function->parameters[i]);
    }
  }
  // Starts with all variables that the group declares together, then removes those that other code
  // writes.
  const auto collect_declared = [&](const auto& self, const std::vector<Region>& list) -> void {
    for (const Region& region : list) {
      for (const Stmt* stmt : region.statements) {
        if (stmt->kind == StmtKind::kDeclare) variables_.insert(stmt->variable);
      }
      for (const auto* inner : {&region.prelude, &region.body, &region.orelse, &region.step}) {
        self(self, *inner);
      }
    }
  };
  collect_declared(collect_declared, regions);
  read_regions(regions);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Write& write : writes_) {
      if (variables_.count(write.variable) == 0) continue;
      if (write.value == nullptr || holds(write.value)) continue;
      variables_.erase(write.variable);
      changed = true;
    }
  }
}

void UniformValues::read_common(const Stmt& stmt) {
  const bool whole = stmt.kind == StmtKind::kDeclare ||
                     (stmt.kind == StmtKind::kAssign && stmt.place->kind == ExprKind::kVariable);
  visit_written(stmt, [&](const Variable* variable, const Expr* value) {
    if (whole && parameters_.count(variable) == 0) {
      writes_.push_back({variable, value});
    } else {
      variables_.erase(variable);
    }
  });
}

void UniformValues::read_regions(const std::vector<Region>& regions) {
  const auto erase = [this](const Variable* variable, const Expr*) { variables_.erase(variable); };
  for (const Region& region : regions) {
    for (const Stmt* stmt : region.statements) {
      read_common(*stmt);
      // Statements nested inside one run under conditions of individual threads.
      const auto on_inner = [&](const Stmt& inner) {
        if (&inner != stmt) visit_written(inner, erase);
      };
      visit(
          *stmt, [](const Expr&) {}, on_inner);
    }
    for (const auto* inner : {&region.prelude, &region.body, &region.orelse, &region.step}) {
      read_regions(*inner);
    }
  }
}

bool UniformValues::holds(const Expr* expr) const {
  switch (expr->kind) {
    case ExprKind::kVariable:
      return expr->variable->storage == Storage::kConstant || variables_.count(expr->variable) != 0;
    case ExprKind::kLoad:
      // Constant buffers do not change during a dispatch; other memory may change between two
      // threads.
      if (!is_constant_buffer(expr->operands[0])) return false;
      break;
    case ExprKind::kLoadElement:
    case ExprKind::kTypedLoad:
    case ExprKind::kSample:
    case ExprKind::kSystemValue:
    case ExprKind::kQueryValue:
    case ExprKind::kTrianglePositions:
    case ExprKind::kClusterId:
      return false;
    default:
      break;
  }
  return std::all_of(expr->operands.begin(), expr->operands.end(),
                     [this](const Expr* operand) { return holds(operand); });
}

void UniformValues::collect(const Expr* expr, std::unordered_set<const Variable*>& out) const {
  visit_expr(expr, [&](const Expr& each) {
    if (each.kind != ExprKind::kVariable || each.variable->storage == Storage::kConstant) return;
    if (!out.insert(each.variable).second) return;
    for (const Write& write : writes_) {
      if (write.variable == each.variable) collect(write.value, out);
    }
  });
}

}  // namespace kaamos::hlsl
