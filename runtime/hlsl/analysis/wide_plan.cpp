// SPDX-License-Identifier: MIT
#include "runtime/hlsl/analysis/wide_plan.h"

#include <algorithm>

#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

bool is_by_reference(const Variable* variable) {
  return variable->storage == Storage::kParameter && variable->mode != ParameterMode::kIn;
}

bool is_of_dispatch(const Expr& system_value) {
  return system_value.system_value == SystemValue::kDispatchRaysIndex ||
         system_value.system_value == SystemValue::kDispatchRaysDimensions;
}

// Walks a function repeatedly until no more varying values are found.
class Analysis {
 public:
  Analysis(WidePlan& plan, WideFunction& out) : plan_(plan), out_(out) {}

  bool run(std::string& reason) {
    const auto& parameters = out_.function->parameters;
    for (size_t i = 0; i < parameters.size(); ++i) {
      if (out_.varying_parameters[i]) mark(parameters[i]);
    }
    do {
      changed_ = false;
      next_region_ = 1;
      for (const Variable* parameter : parameters) region_of_[parameter] = 0;
      walk(out_.function->body, 0);
    } while (changed_ && reason_.empty());
    reason = reason_;
    return reason_.empty();
  }

 private:
  // Masked jumps that leave a statement.
  enum Jumps : uint32_t { kNone = 0, kReturns = 1, kContinues = 2, kBreaks = 4 };

  // The target of a `break` or `continue`.
  struct Target {
    const Stmt* stmt;
    uint32_t region;  // the body's region
  };

  void refuse(const std::string& why) {
    if (reason_.empty()) reason_ = why;
  }
  void mark(const Variable* variable) {
    if (!out_.varying.insert(variable).second) return;
    changed_ = true;
    if (holds_resource(variable->type)) {
      refuse("\"" + variable->name + "\" is a resource that differs among threads");
    }
  }
  void flag(bool& once) {
    if (once) return;
    once = true;
    changed_ = true;
  }

  // Returns whether a write needs a mask; also marks what it makes varying.
  bool write(const Variable* variable, bool varying, uint32_t region) {
    out_.written.insert(variable);
    if (variable->storage == Storage::kStaticGlobal && holds_resource(variable->type)) {
      // The threads have one in common, so all of them must be there.
      if (varying || region != 0 || !out_.has_all_threads) {
        refuse("\"" + variable->name + "\" is a resource that only some threads may change");
      }
      return false;
    }
    if (variable->storage == Storage::kStaticGlobal) return true;
    if (variable->storage == Storage::kGroupShared) {
      refuse("it writes groupshared memory");
      return false;
    }
    const bool outside = is_by_reference(variable);
    const bool same = region_of_[variable] == region && !(outside && out_.masked_return);
    if (varying || !same) mark(variable);
    return out_.is_varying(variable) && (outside || !same);
  }

  void check(const Expr* root) {
    visit_expr(root, [&](const Expr& expr) {
      switch (expr.kind) {
        case ExprKind::kSystemValue:
          if (!is_of_dispatch(expr)) refuse("it reads system values of hits");
          return;
        case ExprKind::kQueryValue:
          return refuse("it traces rays inline");
        case ExprKind::kTrianglePositions:
        case ExprKind::kClusterId:
          return refuse("it reads positions or clusters of triangles");
        case ExprKind::kVariable:
          if (expr.variable->storage == Storage::kGroupShared) {
            refuse("it reads groupshared memory");
          }
          return;
        default:
          break;
      }
      if (expr.type != nullptr && expr.type->kind == TypeKind::kResource &&
          out_.is_varying(&expr)) {
        refuse("it chooses a resource for each thread");
      }
    });
  }

  uint32_t walk(const Block& block, uint32_t region) {
    uint32_t jumps = kNone;
    for (const Stmt* stmt : block) jumps |= walk(*stmt, region);
    return jumps;
  }

  uint32_t walk(const Stmt& stmt, uint32_t region) {
    for (const Expr* expr : {stmt.place, stmt.value, stmt.compare}) check(expr);
    for (const auto* list : {&stmt.operands, &stmt.arguments}) {
      for (const Expr* expr : *list) check(expr);
    }
    WideFacts& facts = out_.facts[&stmt];
    switch (stmt.kind) {
      case StmtKind::kBlock: {
        const uint32_t jumps = walk(stmt.body, region);
        facts.narrows = jumps != kNone;
        return jumps;
      }
      case StmtKind::kDeclare:
        region_of_[stmt.variable] = region;
        if (stmt.value != nullptr && out_.is_varying(stmt.value)) mark(stmt.variable);
        return kNone;
      case StmtKind::kAssign:
        facts.blends = write(root_of(stmt.place),
                             out_.is_varying(stmt.value) || has_varying_index(stmt.place), region);
        return kNone;
      case StmtKind::kStore:
      case StmtKind::kStoreElement:
      case StmtKind::kTypedStore:
        return kNone;
      case StmtKind::kAtomic:
        if (stmt.target == AtomicTarget::kPlace) refuse("it has atomics on groupshared memory");
        if (stmt.result != nullptr) facts.blends = write(stmt.result, true, region);
        return kNone;
      case StmtKind::kCall:
        call(stmt, region, facts);
        return kNone;
      case StmtKind::kIf:
        return walk_if(stmt, region, facts);
      case StmtKind::kLoop:
        return walk_loop(stmt, region);
      case StmtKind::kSwitch:
        return walk_switch(stmt, region);
      case StmtKind::kBreak:
        return walk_break(region, facts);
      case StmtKind::kContinue:
        return walk_continue(region, facts);
      case StmtKind::kReturn:
        facts.masked = region != 0;
        if (facts.masked) flag(out_.masked_return);
        if (stmt.value != nullptr && (out_.is_varying(stmt.value) || out_.masked_return)) {
          flag(out_.varying_result);
        }
        return facts.masked ? kReturns : kNone;
      case StmtKind::kTraceRay:
        if (stmt.result != nullptr) refuse("it has hit objects");
        write(stmt.place->variable, true, region);
        return kNone;
      case StmtKind::kWave: {
        const bool differs =
            stmt.wave != shader::WaveOp::kLaneCount && stmt.wave != shader::WaveOp::kGroupWaveCount;
        facts.blends = write(stmt.result, differs, region);
        return kNone;
      }
      case StmtKind::kDiscard:
        return kNone;
      case StmtKind::kBarrier:
        refuse("it has a barrier");
        return kNone;
      case StmtKind::kQuery:
        refuse("it traces rays inline");
        return kNone;
      case StmtKind::kDebugBreak:
        refuse("it calls DebugBreak");
        return kNone;
      case StmtKind::kCover:
        refuse("it collects coverage");
        return kNone;
      default:
        refuse("it has statements of ray shaders");
        return kNone;
    }
  }

  // a[i].x = ... with a different i in each thread.
  bool has_varying_index(const Expr* place) {
    for (; place->kind != ExprKind::kVariable; place = place->operands[0]) {
      if (place->kind == ExprKind::kElement && out_.is_varying(place->operands[1])) return true;
    }
    return false;
  }

  void call(const Stmt& stmt, uint32_t region, WideFacts& facts) {
    std::vector<bool> varying;
    for (const Expr* argument : stmt.arguments) varying.push_back(out_.is_varying(argument));
    std::string reason;
    const WideFunction* callee = plan_.add(*stmt.function, varying, reason);
    // Most functions do not care, and are there once.
    if (callee == nullptr && out_.has_all_threads && region == 0) {
      callee = plan_.add(*stmt.function, varying, reason, true);
    }
    if (callee == nullptr) return refuse(reason);
    out_.callees[&stmt] = callee;
    for (size_t i = 0; i < varying.size(); ++i) {
      const Variable* parameter = stmt.function->parameters[i];
      if (parameter->mode == ParameterMode::kIn) continue;
      write(stmt.arguments[i]->variable, callee->is_varying(parameter), region);
    }
    if (stmt.result != nullptr) facts.blends = write(stmt.result, callee->varying_result, region);
  }

  uint32_t walk_if(const Stmt& stmt, uint32_t region, WideFacts& facts) {
    facts.masked = out_.is_varying(stmt.value);
    const uint32_t first = facts.masked ? next_region_++ : region;
    const uint32_t second = facts.masked ? next_region_++ : region;
    uint32_t jumps = walk(stmt.body, first);
    jumps |= walk(stmt.orelse, second);
    out_.facts[&stmt].narrows = jumps != kNone;
    return jumps;
  }

  uint32_t walk_loop(const Stmt& stmt, uint32_t region) {
    if (stmt.value != nullptr && out_.is_varying(stmt.value)) flag(out_.facts[&stmt].masked);
    const WideFacts facts = out_.facts[&stmt];
    const uint32_t inner = facts.masked ? next_region_++ : region;
    const uint32_t body = facts.masked_continue ? next_region_++ : inner;
    uint32_t jumps = walk(stmt.prelude, inner);
    targets_.push_back({&stmt, body});
    loops_.push_back({&stmt, body});
    jumps |= walk(stmt.body, body);
    targets_.pop_back();
    loops_.pop_back();
    jumps |= walk(stmt.step, inner);
    jumps &= kReturns;
    out_.facts[&stmt].narrows = jumps != kNone;
    return jumps;
  }

  uint32_t walk_switch(const Stmt& stmt, uint32_t region) {
    if (out_.is_varying(stmt.value)) flag(out_.facts[&stmt].masked);
    const uint32_t inner = out_.facts[&stmt].masked ? next_region_++ : region;
    targets_.push_back({&stmt, inner});
    uint32_t jumps = kNone;
    for (const SwitchCase& c : stmt.cases) jumps |= walk(c.body, inner);
    targets_.pop_back();
    jumps &= kReturns | kContinues;
    out_.facts[&stmt].narrows = jumps != kNone;
    return jumps;
  }

  uint32_t walk_break(uint32_t region, WideFacts& facts) {
    const Target& target = targets_.back();
    WideFacts& aim = out_.facts[target.stmt];
    // In a loop that threads continue one by one, some may already be gone.
    if (region != target.region || aim.masked_continue) flag(aim.masked);
    facts.masked = aim.masked;
    return facts.masked ? kBreaks : kNone;
  }

  uint32_t walk_continue(uint32_t region, WideFacts& facts) {
    const Target& target = loops_.back();
    WideFacts& aim = out_.facts[target.stmt];
    if (region != target.region) flag(aim.masked_continue);
    facts.masked = aim.masked_continue;
    return facts.masked ? kContinues : kNone;
  }

  WidePlan& plan_;
  WideFunction& out_;
  std::string reason_;
  std::unordered_map<const Variable*, uint32_t> region_of_;
  std::vector<Target> targets_;
  std::vector<Target> loops_;
  uint32_t next_region_ = 1;
  bool changed_ = false;
};

}  // namespace

bool holds_resource(const Type* type) {
  switch (type->kind) {
    case TypeKind::kResource:
      return true;
    case TypeKind::kArray:
      return holds_resource(type->element);
    case TypeKind::kStruct:
      return std::any_of(type->structure->fields.begin(), type->structure->fields.end(),
                         [](const Field& field) { return holds_resource(field.type); });
    default:
      return false;
  }
}

bool WideFunction::only_reads(const Variable* parameter) const {
  const auto& all = function->parameters;
  return is_varying(parameter) && parameter->type->kind != TypeKind::kScalar &&
         written.count(parameter) == 0 && std::none_of(all.begin(), all.end(), is_by_reference);
}

bool WideFunction::is_varying(const Variable* variable) const {
  const bool is_own =
      variable->storage == Storage::kStaticGlobal && !holds_resource(variable->type);
  return is_own || varying.count(variable) != 0;
}

bool WideFunction::is_varying(const Expr* expr) const {
  if (expr == nullptr) return false;
  if (expr->kind == ExprKind::kVariable) return is_varying(expr->variable);
  if (expr->kind == ExprKind::kSystemValue) {
    return expr->system_value == SystemValue::kDispatchRaysIndex;
  }
  return std::any_of(expr->operands.begin(), expr->operands.end(),
                     [this](const Expr* operand) { return is_varying(operand); });
}

const WideFunction* WidePlan::add(const Function& function,
                                  const std::vector<bool>& varying_parameters, std::string& reason,
                                  bool has_all_threads) {
  auto& known = functions_[{&function, has_all_threads, varying_parameters}];
  if (known == nullptr) {
    auto made = std::make_unique<WideFunction>();
    made->function = &function;
    made->has_all_threads = has_all_threads;
    made->varying_parameters = varying_parameters;
    if (!Analysis(*this, *made).run(reason)) return nullptr;
    // Analysis may have added other functions; the reference into the map stays valid.
    known = std::move(made);
  }
  return known.get();
}

const WideFunction* WidePlan::add(const EntryPoint& entry, std::string& reason) {
  if (entry.stage != kStageCompute && entry.stage != kStagePixel && entry.function->has_waves) {
    reason = "it shares wave operations with compute shaders";
    return nullptr;
  }
  std::vector<bool> varying;
  for (size_t i = 0; i < entry.parameters.size(); ++i) {
    // The pixels that run together are of one triangle.
    const bool is_flat = entry.stage == kStagePixel && i < entry.inputs.size() &&
                         shader::is_flat(entry.inputs[i].interpolation);
    varying.push_back(entry.parameters[i] != EntryParameter::kGroupId && !is_flat);
  }
  return add(*entry.function, varying, reason, true);
}

}  // namespace kaamos::hlsl
