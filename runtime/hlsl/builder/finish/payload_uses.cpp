// SPDX-License-Identifier: MIT
// The payload is followed through calls; every path through a body counts.
#include "runtime/hlsl/builder/finish/payload_uses.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "runtime/hlsl/ir/visit.h"

namespace kaamos::hlsl {
namespace {

enum FieldState : uint8_t {
  kUndefined = 1,     // on some path
  kAfterTrace = 2,    // because TraceRay did not return it
  kMayBeWritten = 4,  // by the source, on some path
  kMayBeLeft = 8,     // not written on some path
};

class PayloadUses {
 public:
  PayloadUses(const PayloadFacts& facts, uint32_t stage, PayloadReport& report)
      : facts_(facts), stage_(payload_stage_of(stage)), report_(report) {}

  void check(const ir::Function& function, const ir::Struct* structure, SourcePlace parameter) {
    State state;
    const ir::Variable* payload = nullptr;
    if (stage_ != kPayloadCaller && structure) {
      payload = function.parameters[0];
      Fields& fields = track(state, payload, structure);
      for (size_t i = 0; i < fields.leaves->size(); ++i) {
        fields.states[i] = kMayBeLeft;
        if (!((*fields.leaves)[i].access.read & stage_)) fields.states[i] |= kUndefined;
      }
      fields.of_stage = true;
    }
    const State end = walk_function(function, std::move(state));
    if (!payload) return;
    for (const auto& [leaf, place] : dropped_) {
      // If a shader passes its payload on, the next trace receives the value.
      if (passed_on_.count(leaf)) continue;
      report_.payload_fault(PayloadFault::kDropped, place, leaf->name, stage_);
    }
    const auto found = end.fields.find(payload);
    if (found == end.fields.end()) return;
    for (size_t i = 0; i < found->second.leaves->size(); ++i) {
      const PayloadLeaf& leaf = (*found->second.leaves)[i];
      const bool only_writes = (leaf.access.write & stage_) && !(leaf.access.read & stage_);
      const bool written_before = leaf.access.write & (kPayloadCaller | kPayloadAnyHit);
      if (only_writes && written_before && (found->second.states[i] & kMayBeLeft)) {
        report_.payload_fault(PayloadFault::kDataLoss, parameter, leaf.name, stage_);
      }
    }
  }

 private:
  struct Fields {
    const PayloadLeaves* leaves = nullptr;
    std::vector<uint8_t> states;  // FieldState
    bool of_stage = false;        // the payload that the shader received
    bool operator==(const Fields&) const = default;
  };
  struct State {
    std::map<const ir::Variable*, Fields> fields;
    bool reachable = true;
  };
  struct Jumps {
    std::optional<State> out;
  };

  Fields& track(State& state, const ir::Variable* variable, const ir::Struct* structure) {
    Fields& fields = state.fields[variable];
    if (!fields.leaves) {
      fields.leaves = &facts_.structs.at(structure);
      fields.states.assign(fields.leaves->size(), kMayBeLeft);
    }
    return fields;
  }

  static void merge(State& into, const State& from) {
    if (!from.reachable) return;
    if (!into.reachable) {
      into = from;
      return;
    }
    for (const auto& [variable, fields] : from.fields) {
      Fields& to = into.fields[variable];
      if (!to.leaves) {
        to = fields;
        continue;
      }
      for (size_t i = 0; i < fields.states.size(); ++i) to.states[i] |= fields.states[i];
    }
  }
  static void merge(std::optional<State>& into, const State& from) {
    if (into) {
      merge(*into, from);
    } else {
      into = from;
    }
  }

  // The leaves that a chain of fields selects on a tracked variable: [first, last).
  Fields* select(State& state, const ir::Expr* expr, size_t& first, size_t& last) {
    std::vector<uint32_t> path;
    for (; expr->kind != ir::ExprKind::kVariable; expr = expr->operands[0]) {
      if (expr->kind == ir::ExprKind::kField) {
        path.push_back(expr->index);
      } else if (expr->kind == ir::ExprKind::kElement || expr->kind == ir::ExprKind::kSwizzle ||
                 expr->kind == ir::ExprKind::kMatrixSwizzle) {
        path.clear();  // inside a leaf
      } else {
        return nullptr;
      }
    }
    const auto found = state.fields.find(expr->variable);
    if (found == state.fields.end()) return nullptr;
    std::reverse(path.begin(), path.end());
    const PayloadLeaves& leaves = *found->second.leaves;
    const auto fits = [&](const PayloadLeaf& leaf) {
      const size_t common = std::min(leaf.path.size(), path.size());
      return std::equal(leaf.path.begin(), leaf.path.begin() + static_cast<ptrdiff_t>(common),
                        path.begin());
    };
    first = 0;
    while (first < leaves.size() && !fits(leaves[first])) ++first;
    last = first;
    while (last < leaves.size() && fits(leaves[last])) ++last;
    return &found->second;
  }

  const SourcePlace* source_of(const ir::Expr* expr) const {
    const auto found = facts_.accesses.find(expr);
    return found == facts_.accesses.end() ? nullptr : &found->second;
  }

  void read(State& state, const ir::Expr* expr) {
    if (!state.reachable) return;
    ir::visit_expr(expr, [&](const ir::Expr& one) {
      const SourcePlace* source = one.kind == ir::ExprKind::kField ? source_of(&one) : nullptr;
      size_t first = 0;
      size_t last = 0;
      Fields* fields = source ? select(state, &one, first, last) : nullptr;
      // Reading a nested payload struct as a whole says nothing about its fields.
      if (!fields || last != first + 1 || !(fields->states[first] & kUndefined)) return;
      report_.payload_fault(fields->states[first] & kAfterTrace ? PayloadFault::kNotReturned
                                                                : PayloadFault::kUndefined,
                            *source, (*fields->leaves)[first].name, stage_);
    });
  }

  void write(State& state, const ir::Expr* place) {
    if (!state.reachable) return;
    const SourcePlace* source = nullptr;
    for (const ir::Expr* one = place;
         one->kind != ir::ExprKind::kVariable && !one->operands.empty(); one = one->operands[0]) {
      if (one->kind == ir::ExprKind::kElement) read(state, one->operands[1]);
      if (!source) source = source_of(one);
    }
    const bool whole = place->kind == ir::ExprKind::kVariable;
    if (!source && !whole) return;  // made by the compiler itself
    size_t first = 0;
    size_t last = 0;
    Fields* fields = select(state, place, first, last);
    if (!fields) return;
    for (size_t i = first; i < last; ++i) {
      const PayloadLeaf& leaf = (*fields->leaves)[i];
      if (fields->of_stage && !whole && !(leaf.access.write & stage_)) {
        dropped_.push_back({&leaf, *source});
      }
      // Assigning a whole struct initialises it, but says nothing about its individual fields.
      fields->states[i] = whole ? 0 : kMayBeWritten;
    }
  }

  void trace(State& state, const ir::Stmt& stmt) {
    const auto found = facts_.traces.find(&stmt);
    if (found == facts_.traces.end() || !state.reachable) return;
    const TracePayload& payload = found->second;
    Fields& fields = track(state, payload.variable, payload.structure);
    for (size_t i = 0; i < fields.leaves->size(); ++i) {
      const PayloadLeaf& leaf = (*fields.leaves)[i];
      const PayloadAccessBits access = as_caller(leaf.access, payload.roles);
      if (fields.of_stage && (access.write & kPayloadCaller)) passed_on_.insert(&leaf);
      if (!(access.write & kPayloadCaller) && (fields.states[i] & kMayBeWritten)) {
        report_.payload_fault(PayloadFault::kNotPassed, payload.place, leaf.name, stage_);
      }
      const uint8_t left = fields.states[i] & kMayBeLeft;
      fields.states[i] = access.read & kPayloadCaller ? left : left | kUndefined | kAfterTrace;
    }
  }

  void call(State& state, const ir::Stmt& stmt) {
    const ir::Function& callee = *stmt.function;
    State inside;
    for (size_t i = 0; i < stmt.arguments.size(); ++i) {
      const ir::Expr* argument = stmt.arguments[i];
      const auto found = argument->kind == ir::ExprKind::kVariable
                             ? state.fields.find(argument->variable)
                             : state.fields.end();
      if (found == state.fields.end()) {
        read(state, argument);
        continue;
      }
      const ir::ParameterMode mode = callee.parameters[i]->mode;
      Fields fields = found->second;
      if (mode == ir::ParameterMode::kIn) fields.of_stage = false;
      if (mode == ir::ParameterMode::kOut) {
        for (uint8_t& one : fields.states) one &= static_cast<uint8_t>(~(kUndefined | kAfterTrace));
      }
      inside.fields[callee.parameters[i]] = std::move(fields);
    }
    if (!state.reachable) return;
    const State after = walk_function(callee, inside);
    for (size_t i = 0; i < stmt.arguments.size(); ++i) {
      const auto found = after.fields.find(callee.parameters[i]);
      if (found == after.fields.end() || !inside.fields.count(callee.parameters[i])) continue;
      if (callee.parameters[i]->mode == ir::ParameterMode::kIn) continue;
      state.fields[stmt.arguments[i]->variable].states = found->second.states;
    }
  }

  State walk_function(const ir::Function& function, State state) {
    Known& known = known_[&function];
    for (const auto& [in, out] : known) {
      if (in.fields == state.fields) return out;
    }
    const State in = state;
    std::vector<Jumps> loops;
    loops.swap(breaks_);
    std::optional<State> outer;
    outer.swap(returns_);
    walk(function.body, state);
    if (returns_) merge(state, *returns_);
    returns_.swap(outer);
    loops.swap(breaks_);
    state.reachable = true;
    known_[&function].emplace_back(in, state);
    return state;
  }

  void walk(const ir::Block& block, State& state) {
    for (const ir::Stmt* stmt : block) walk(*stmt, state);
  }

  void walk(const ir::Stmt& stmt, State& state) {
    using ir::StmtKind;
    if (stmt.kind == StmtKind::kCall) return call(state, stmt);
    if (stmt.value) read(state, stmt.value);
    if (stmt.compare) read(state, stmt.compare);
    for (const ir::Expr* operand : stmt.operands) read(state, operand);
    switch (stmt.kind) {
      case StmtKind::kDeclare: {
        const ir::Type* type = stmt.variable->type;
        if (!state.reachable || !facts_.structs.count(type->structure)) break;
        state.fields.erase(stmt.variable);
        track(state, stmt.variable, type->structure);
        break;
      }
      case StmtKind::kAssign:
        write(state, stmt.place);
        break;
      case StmtKind::kTraceRay:
      case StmtKind::kInvoke:
        trace(state, stmt);
        break;
      case StmtKind::kBlock:
        walk(stmt.body, state);
        break;
      case StmtKind::kIf: {
        State other = state;
        walk(stmt.body, state);
        walk(stmt.orelse, other);
        merge_branches(state, other);
        break;
      }
      case StmtKind::kLoop:
        loop(stmt, state);
        break;
      case StmtKind::kSwitch:
        switches(stmt, state);
        break;
      case StmtKind::kBreak:
        if (state.reachable && !breaks_.empty()) merge(breaks_.back().out, state);
        state.reachable = false;
        break;
      case StmtKind::kContinue:
        // Treat what it skips as possibly unwritten after the loop too.
        if (state.reachable && !breaks_.empty()) merge(breaks_.back().out, state);
        state.reachable = false;
        break;
      case StmtKind::kReturn:
      case StmtKind::kIgnoreHit:
      case StmtKind::kAcceptHitAndEndSearch:
        if (state.reachable) merge(returns_, state);
        state.reachable = false;
        break;
      default:
        break;
    }
  }

  static void merge_branches(State& state, const State& other) {
    if (!state.reachable) {
      const State kept = other;
      state = kept;
      return;
    }
    merge(state, other);
  }

  void loop(const ir::Stmt& stmt, State& state) {
    // The second round starts with what the first leaves, because a trace in the body may
    // invalidate fields.
    const int rounds = breaks_.size() < 4 ? 2 : 1;
    for (int i = 0; i < rounds; ++i) {
      State once = state;
      breaks_.emplace_back();
      if (!stmt.test_at_end) {
        walk(stmt.prelude, once);
        if (stmt.value) read(once, stmt.value);
      }
      walk(stmt.body, once);
      walk(stmt.step, once);
      if (stmt.test_at_end) walk(stmt.prelude, once);
      const std::optional<State> left = std::move(breaks_.back().out);
      breaks_.pop_back();
      if (left) merge_branches(once, *left);
      if (stmt.test_at_end) {
        if (i + 1 == rounds || !once.reachable) {
          state = once;
        } else {
          merge(state, once);
        }
      } else {
        merge(state, once);
      }
    }
  }

  void switches(const ir::Stmt& stmt, State& state) {
    const State start = state;
    bool has_default = false;
    breaks_.emplace_back();
    state.reachable = false;
    for (const ir::SwitchCase& one : stmt.cases) {
      has_default = has_default || one.is_default;
      merge_branches(state, start);
      walk(one.body, state);
    }
    if (breaks_.back().out) merge_branches(state, *breaks_.back().out);
    breaks_.pop_back();
    if (!has_default) merge_branches(state, start);
  }

  using Known = std::vector<std::pair<State, State>>;
  const PayloadFacts& facts_;
  const uint8_t stage_;
  PayloadReport& report_;
  std::map<const ir::Function*, Known> known_;
  std::vector<std::pair<const PayloadLeaf*, SourcePlace>> dropped_;
  std::set<const PayloadLeaf*> passed_on_;
  std::vector<Jumps> breaks_;
  std::optional<State> returns_;
};

}  // namespace

void check_payload_uses(const PayloadFacts& facts, const ir::Function& function, uint32_t stage,
                        const ir::Struct* payload, SourcePlace parameter, PayloadReport& report) {
  PayloadUses(facts, stage, report).check(function, payload, parameter);
}

}  // namespace kaamos::hlsl
