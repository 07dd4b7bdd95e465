// SPDX-License-Identifier: MIT
//
// Compute shaders that are cut at their barriers (split_groups.h): one function for the group, with
// a loop over its threads for each piece. What threads keep across pieces is in arrays with one
// element per thread.
#include <algorithm>

#include "runtime/hlsl/cpp/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

// A limit, because it is on the stack of the thread that runs the group.
constexpr uint64_t kMostKeptBytes = 256 * 1024;

uint64_t thread_count(const EntryPoint& entry) {
  return uint64_t{entry.thread_group[0]} * entry.thread_group[1] * entry.thread_group[2];
}

}  // namespace

uint64_t CppEmitter::kept_bytes(const EntryPoint& entry, const GroupPlan& plan) const {
  uint64_t bytes = plan.may_return ? 1 : 0;
  for (const Variable* variable : plan.kept) bytes += stack_bytes(variable->type);
  const auto statics = statics_.find(entry.function);
  if (statics != statics_.end() && !statics->second.empty()) {
    for (const Variable* variable : module_.globals) {
      if (variable->storage == Storage::kStaticGlobal) bytes += stack_bytes(variable->type);
    }
  }
  return bytes * thread_count(entry);
}

bool CppEmitter::emit_split_group(size_t index) {
  const EntryPoint& entry = module_.entry_points[index];
  if (!options_.split_groups || entry.function->has_waves) return false;
  std::string reason;
  const std::optional<GroupPlan> plan = plan_group(entry, reason);
  if (!plan || kept_bytes(entry, *plan) > kMostKeptBytes) return false;
  current_ = entry.function;
  at(entry.function->location);
  open("static void group_" + std::to_string(index) +
       "(ks::Invocation& invocation, ks::ComputeGroup& group) {");
  local_names_.push();
  // Names that the emitted code itself uses; HLSL variables with these names are renamed.
  for (const char* name : {"invocation", "group", "thread", "size", "n", "alive", "ended",
                           "statics", "bound", "used"}) {
    local_names_.declare(name);
  }
  emit_group_body(entry, *plan);
  local_names_.pop();
  close("}");
  placed_.clear();
  return_text_ = "return;";
  current_ = nullptr;
  return true;
}

void CppEmitter::emit_group_body(const EntryPoint& entry, const GroupPlan& plan) {
  line("[[maybe_unused]] constexpr uint32_t size[3] = {" + std::to_string(entry.thread_group[0]) +
       ", " + std::to_string(entry.thread_group[1]) + ", " + std::to_string(entry.thread_group[2]) +
       "};");
  line("u::Context ctx(invocation);");
  emit_bound(entry);
  if (binds_per_group_) line("ctx.bound = bound;");
  line("ctx.shared = static_cast<u::Shared*>(group.shared);");
  emit_group_variables(entry, plan);
  emit_first_piece(entry, plan);
  emit_regions(entry, plan, plan.regions);
}

void CppEmitter::emit_group_variables(const EntryPoint& entry, const GroupPlan& plan) {
  const std::string count = std::to_string(thread_count(entry));
  const auto& parameters = entry.function->parameters;
  // Sorted by id in the module, so that the text does not depend on addresses.
  std::vector<const Variable*> variables(plan.uniform.begin(), plan.uniform.end());
  variables.insert(variables.end(), plan.kept.begin(), plan.kept.end());
  std::sort(variables.begin(), variables.end(),
            [](const Variable* a, const Variable* b) { return a->id < b->id; });
  for (const Variable* variable : variables) {
    const std::string name = local_names_.declare(variable->name);
    const bool is_kept = plan.kept.count(variable) != 0;
    const auto parameter = std::find(parameters.begin(), parameters.end(), variable);
    variable_names_[variable] = name + (is_kept ? "[n]" : "");
    placed_.insert(variable);
    if (is_kept) {
      line(type(variable->type) + " " + name + "[" + count + "];");
    } else if (parameter == parameters.end()) {
      line(type(variable->type) + " " + name + "{};");
    } else {
      const auto i = static_cast<size_t>(parameter - parameters.begin());
      line("[[maybe_unused]] const " + type(variable->type) + " " + name + " = " +
           entry_argument(entry, i) + ";");
    }
  }
  if (!statics_[entry.function].empty()) line("u::Statics statics[" + count + "];");
  if (plan.may_return) {
    line("bool ended[" + count + "] = {};");
    line("uint32_t alive = " + count + ";");
  }
}

// Opens the loop over the threads and declares the entry point's parameters in it.
void CppEmitter::emit_piece_start(const EntryPoint& entry) {
  open("{");
  line("[[maybe_unused]] uint32_t n = 0;");
  line("uint32_t thread[3];");
  for (int axis = 2; axis >= 0; --axis) {
    const std::string t = "thread[" + std::to_string(axis) + "]";
    line("for (" + t + " = 0; " + t + " < size[" + std::to_string(axis) + "]; ++" + t +
         (axis == 0 ? ", ++n) {" : ")"));
  }
  ++indent_;
  if (!statics_[entry.function].empty()) line("ctx.statics = statics[n];");
  for (size_t i = 0; i < entry.parameters.size(); ++i) {
    const Variable* parameter = entry.function->parameters[i];
    if (placed_.count(parameter) != 0) continue;
    variable_names_[parameter] = local_names_.declare(parameter->name);
    line("[[maybe_unused]] const " + type(parameter->type) + " " + variable_names_[parameter] +
         " = " + entry_argument(entry, i) + ";");
  }
}

void CppEmitter::emit_piece_end() {
  close("}");
  close("}");
}

// Sets up static globals and the parameters that threads write.
void CppEmitter::emit_first_piece(const EntryPoint& entry, const GroupPlan& plan) {
  const bool has_statics = !statics_[entry.function].empty();
  bool keeps_parameters = false;
  for (const Variable* parameter : entry.function->parameters) {
    keeps_parameters = keeps_parameters || plan.kept.count(parameter) != 0;
  }
  if (!has_statics && !keeps_parameters) return;
  at_generated();
  local_names_.push();
  emit_piece_start(entry);
  emit_static_initialisers(*entry.function);
  if (has_statics) line("statics[n] = ctx.statics;");
  for (size_t i = 0; i < entry.parameters.size(); ++i) {
    const Variable* parameter = entry.function->parameters[i];
    if (plan.kept.count(parameter) == 0) continue;
    line(variable(parameter) + " = " + entry_argument(entry, i) + ";");
  }
  emit_piece_end();
  local_names_.pop();
}

void CppEmitter::emit_threads(const EntryPoint& entry, const GroupPlan& plan,
                              const Region& region) {
  const int label = next_label_++;
  const std::string next = "next_" + std::to_string(label);
  return_text_ = "{ ended[n] = true; --alive; goto " + next + "; }";
  local_names_.push();
  emit_piece_start(entry);
  if (plan.may_return) line("if (ended[n]) continue;");
  open("{");
  block(region.statements);
  close("}");
  // The label is before the end of the loop's body, where the statements' variables are out of
  // scope.
  if (region.may_return) line(next + ":;");
  if (!statics_[entry.function].empty()) line("statics[n] = ctx.statics;");
  emit_piece_end();
  local_names_.pop();
  if (region.may_return) line("if (alive == 0) return;");
  return_text_ = "return;";
}

void CppEmitter::emit_region_loop(const EntryPoint& entry, const GroupPlan& plan,
                                  const Region& region) {
  const int label = next_label_++;
  const auto condition = [&] {
    emit_regions(entry, plan, region.prelude);
    if (region.stmt->value != nullptr) {
      at(region.stmt->location);
      line("if (!(" + value(region.stmt->value) + ")) break;");
    }
  };
  open("for (;;) {");
  if (!region.stmt->test_at_end) condition();
  loops_.push_back(label);
  open("{");
  emit_regions(entry, plan, region.body);
  close("}");
  loops_.pop_back();
  if (used_labels_.count(label) != 0) line("continue_" + std::to_string(label) + ":;");
  emit_regions(entry, plan, region.step);
  if (region.stmt->test_at_end) condition();
  close("}");
}

void CppEmitter::emit_regions(const EntryPoint& entry, const GroupPlan& plan,
                              const std::vector<Region>& regions) {
  for (const Region& region : regions) {
    switch (region.kind) {
      case RegionKind::kThreads:
        emit_threads(entry, plan, region);
        break;
      case RegionKind::kBarrier:
        at(region.stmt->location);
        line("ks::barrier(invocation, nullptr, " + std::to_string(region.stmt->barrier) + "u);");
        break;
      case RegionKind::kIf:
        at(region.stmt->location);
        open("if (" + value(region.stmt->value) + ") {");
        emit_regions(entry, plan, region.body);
        close("} else {");
        ++indent_;
        emit_regions(entry, plan, region.orelse);
        close("}");
        break;
      case RegionKind::kLoop:
        at(region.stmt->location);
        emit_region_loop(entry, plan, region);
        break;
      case RegionKind::kOnce:
      case RegionKind::kBreak:
      case RegionKind::kContinue:
      case RegionKind::kReturn:
        statement(*region.stmt);
        break;
    }
  }
}

}  // namespace kaamos::hlsl
