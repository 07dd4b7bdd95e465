// SPDX-License-Identifier: MIT
#include "runtime/hlsl/analysis/split_groups.h"

#include <unordered_map>

#include "runtime/hlsl/analysis/uniform_values.h"
#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

bool waits(const Stmt& stmt) {
  return (stmt.kind == StmtKind::kBarrier && (stmt.barrier & kGroupSync) != 0) ||
         (stmt.kind == StmtKind::kCall && stmt.function->has_barrier);
}

bool holds_barrier(const Stmt& stmt) {
  bool found = false;
  visit(
      stmt, [](const Expr&) {}, [&](const Stmt& each) { found = found || waits(each); });
  return found;
}

bool holds_return(const Stmt& stmt) {
  bool found = false;
  visit(
      stmt, [](const Expr&) {},
      [&](const Stmt& each) { found = found || each.kind == StmtKind::kReturn; });
  return found;
}

// Returns whether a break or continue leaves the statement.
bool leaves(const Stmt& stmt, bool in_loop, bool in_switch) {
  if (stmt.kind == StmtKind::kBreak) return !in_loop && !in_switch;
  if (stmt.kind == StmtKind::kContinue) return !in_loop;
  const bool loop = in_loop || stmt.kind == StmtKind::kLoop;
  const bool inner_switch = in_switch || stmt.kind == StmtKind::kSwitch;
  for (const Block* block : {&stmt.prelude, &stmt.body, &stmt.orelse, &stmt.step}) {
    for (const Stmt* inner : *block) {
      if (leaves(*inner, loop, inner_switch)) return true;
    }
  }
  for (const SwitchCase& c : stmt.cases) {
    for (const Stmt* inner : c.body) {
      if (leaves(*inner, loop, inner_switch)) return true;
    }
  }
  return false;
}

class Planner {
 public:
  explicit Planner(const EntryPoint& entry) : entry_(entry) {}

  std::optional<GroupPlan> run(std::string& reason) {
    if (!entry_.function->has_barrier) {
      reason = "it has no barriers";
      return std::nullopt;
    }
    block(entry_.function->body, plan_.regions, true);
    if (reason_.empty()) find_uniform();
    if (reason_.empty()) {
      plan_.regions = extract_once(std::move(plan_.regions));
      find_kept(plan_.regions);
      keep_written_parameters();
    }
    reason = reason_;
    if (!reason.empty()) return std::nullopt;
    return std::move(plan_);
  }

 private:
  void fail(const std::string& why) {
    if (reason_.empty()) reason_ = why;
  }

  // ---- Regions that follow the structure of the statements

  void block(const Block& body, std::vector<Region>& out, bool in_entry) {
    for (const Stmt* stmt : body) statement(*stmt, out, in_entry);
  }

  Region& add(std::vector<Region>& out, RegionKind kind, const Stmt& stmt) {
    Region& region = out.emplace_back();
    region.kind = kind;
    region.stmt = &stmt;
    return region;
  }

  void statement(const Stmt& stmt, std::vector<Region>& out, bool in_entry) {
    if (!waits(stmt) && !holds_barrier(stmt) && !leaves(stmt, false, false)) {
      return for_threads(stmt, out, in_entry);
    }
    switch (stmt.kind) {
      case StmtKind::kBlock:
        return block(stmt.body, out, in_entry);
      case StmtKind::kBarrier:
        add(out, RegionKind::kBarrier, stmt);
        return;
      case StmtKind::kIf: {
        Region region;
        region.kind = RegionKind::kIf;
        region.stmt = &stmt;
        block(stmt.body, region.body, in_entry);
        block(stmt.orelse, region.orelse, in_entry);
        out.push_back(std::move(region));
        return;
      }
      case StmtKind::kLoop: {
        Region region;
        region.kind = RegionKind::kLoop;
        region.stmt = &stmt;
        block(stmt.prelude, region.prelude, in_entry);
        block(stmt.body, region.body, in_entry);
        block(stmt.step, region.step, in_entry);
        out.push_back(std::move(region));
        return;
      }
      case StmtKind::kBreak:
        add(out, RegionKind::kBreak, stmt);
        return;
      case StmtKind::kContinue:
        add(out, RegionKind::kContinue, stmt);
        return;
      case StmtKind::kCall:
        return inlined(stmt, out);
      default:
        return fail("a barrier, or a way out of a loop with barriers, is in a switch");
    }
  }

  void for_threads(const Stmt& stmt, std::vector<Region>& out, bool in_entry) {
    if (stmt.kind == StmtKind::kReturn && in_entry) {
      add(out, RegionKind::kReturn, stmt);
      return;
    }
    const bool returns = holds_return(stmt);
    if (returns && !in_entry) return fail("a function with barriers returns before its end");
    if (out.empty() || out.back().kind != RegionKind::kThreads) out.emplace_back();
    out.back().statements.push_back(&stmt);
    out.back().may_return = out.back().may_return || returns;
    plan_.may_return = plan_.may_return || returns;
  }

  // ---- Functions inlined at their calls

  Stmt& make(StmtKind kind, const Stmt& at) {
    Stmt& stmt = plan_.statements.emplace_back();
    stmt.kind = kind;
    stmt.location = at.location;
    return stmt;
  }
  const Expr* read(const Variable* variable, const Stmt& at) {
    Expr& expr = plan_.expressions.emplace_back();
    expr.kind = ExprKind::kVariable;
    expr.type = variable->type;
    expr.variable = variable;
    expr.location = at.location;
    return &expr;
  }
  void assign(const Variable* to, const Expr* value, const Stmt& at, std::vector<Region>& out) {
    Stmt& stmt = make(StmtKind::kAssign, at);
    stmt.place = read(to, at);
    stmt.value = value;
    for_threads(stmt, out, false);
  }

  // The parameters become variables. A reference's target is not accessible in any other way, so
  // copying in and out has the same effect. A second call declares them again.
  void inlined(const Stmt& call, std::vector<Region>& out) {
    const Function& function = *call.function;
    for (size_t i = 0; i < function.parameters.size(); ++i) {
      const Variable* parameter = function.parameters[i];
      Stmt& declare = make(StmtKind::kDeclare, call);
      declare.variable = parameter;
      declare.value = parameter->mode == ParameterMode::kOut ? nullptr : call.arguments[i];
      for_threads(declare, out, false);
    }
    Block body = function.body;
    const Stmt* last = body.empty() ? nullptr : body.back();
    const bool ends_with_value = last != nullptr && last->kind == StmtKind::kReturn;
    if (ends_with_value) body.pop_back();
    block(body, out, false);
    if (call.result != nullptr) {
      const bool has_value = ends_with_value && last->value != nullptr;
      if (!has_value) return fail("a function with barriers may end without its result");
      assign(call.result, last->value, call, out);
    }
    for (size_t i = 0; i < function.parameters.size(); ++i) {
      const Variable* parameter = function.parameters[i];
      if (parameter->mode == ParameterMode::kIn) continue;
      assign(call.arguments[i]->variable, read(parameter, call), call, out);
    }
  }

  // ---- Uniform conditions

  void find_uniform() {
    const UniformValues values(entry_, plan_.regions);
    check_conditions(plan_.regions, values);
  }

  void check_conditions(const std::vector<Region>& regions, const UniformValues& values) {
    for (const Region& region : regions) {
      const bool conditional = region.kind == RegionKind::kIf || region.kind == RegionKind::kLoop;
      if (conditional && region.stmt->value != nullptr) {
        if (!values.holds(region.stmt->value)) {
          return fail("a condition around a barrier may differ between threads (line " +
                      std::to_string(region.stmt->location.line) + ")");
        }
        values.collect(region.stmt->value, plan_.uniform);
      }
      for (const auto* inner : {&region.prelude, &region.body, &region.orelse, &region.step}) {
        check_conditions(*inner, values);
      }
    }
  }

  bool writes_uniform(const Stmt& stmt) const {
    if (stmt.kind == StmtKind::kDeclare) return plan_.uniform.count(stmt.variable) != 0;
    return stmt.kind == StmtKind::kAssign && stmt.place->kind == ExprKind::kVariable &&
           plan_.uniform.count(stmt.place->variable) != 0;
  }

  // Moves the statements that write the group's variables out of the threads' pieces.
  std::vector<Region> extract_once(std::vector<Region> regions) {
    std::vector<Region> out;
    for (Region& region : regions) {
      for (auto* inner : {&region.prelude, &region.body, &region.orelse, &region.step}) {
        *inner = extract_once(std::move(*inner));
      }
      if (region.kind != RegionKind::kThreads) {
        out.push_back(std::move(region));
        continue;
      }
      for (const Stmt* stmt : region.statements) {
        if (writes_uniform(*stmt)) {
          add(out, RegionKind::kOnce, *stmt);
          continue;
        }
        if (out.empty() || out.back().kind != RegionKind::kThreads) out.emplace_back();
        out.back().statements.push_back(stmt);
        out.back().may_return = out.back().may_return || holds_return(*stmt);
      }
    }
    return out;
  }

  // ---- Variables that live across pieces

  void use(const Variable* variable, const Region* region) {
    const bool own = variable != nullptr && (variable->storage == Storage::kLocal ||
                                             variable->storage == Storage::kParameter);
    if (!own || plan_.uniform.count(variable) != 0 || is_entry_parameter(variable)) return;
    const auto [found, first] = used_in_.emplace(variable, region);
    if (!first && found->second != region) plan_.kept.insert(variable);
  }

  void find_kept(const std::vector<Region>& regions) {
    for (const Region& region : regions) {
      for (const Stmt* stmt : region.statements) {
        const auto on_expr = [&](const Expr& expr) {
          if (expr.kind == ExprKind::kVariable) use(expr.variable, &region);
        };
        const auto on_stmt = [&](const Stmt& each) {
          if (each.kind == StmtKind::kDeclare) use(each.variable, &region);
          if (each.result != nullptr) use(each.result, &region);
        };
        visit(*stmt, on_expr, on_stmt);
      }
      for (const auto* inner : {&region.prelude, &region.body, &region.orelse, &region.step}) {
        find_kept(*inner);
      }
    }
  }

  bool is_entry_parameter(const Variable* variable) const {
    for (const Variable* parameter : entry_.function->parameters) {
      if (parameter == variable) return true;
    }
    return false;
  }

  // Parameters that nothing writes are set up again for each piece.
  void keep_written_parameters() {
    visit(
        entry_.function->body, [](const Expr&) {},
        [&](const Stmt& stmt) {
          visit_written(stmt, [&](const Variable* variable, const Expr*) {
            if (is_entry_parameter(variable)) plan_.kept.insert(variable);
          });
        });
  }

  const EntryPoint& entry_;
  GroupPlan plan_;
  std::string reason_;
  std::unordered_map<const Variable*, const Region*> used_in_;
};

}  // namespace

std::optional<GroupPlan> plan_group(const EntryPoint& entry, std::string& reason) {
  return Planner(entry).run(reason);
}

}  // namespace kaamos::hlsl
