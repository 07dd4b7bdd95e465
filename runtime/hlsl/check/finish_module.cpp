// SPDX-License-Identifier: MIT
// What the call graph says about each function, and what finally goes into the module.
#include <algorithm>

#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {
namespace {

constexpr size_t kNamesShown = 5;

}  // namespace

void Checker::mark_reachable(FunctionInfo* function, ir::EntryPoint& entry, uint32_t mark,
                             std::set<uint32_t>& globals) {
  if (function->visit_mark == mark) return;
  function->visit_mark = mark;
  if (entry.imports.empty()) {
    function->stages |= entry.stage;
    if (function->ir) function->ir->stages |= entry.stage;
  }
  entry.attribute_bytes = std::max(entry.attribute_bytes, function->reported_bytes);
  entry.attribute_type = joined_type(entry.attribute_type, function->reported_type);
  for (const StageUse& use : function->stage_uses) {
    if ((use.stages & entry.stage) == 0) report_stage_use(use, entry.stage, entry.name);
  }
  for (BindingInfo* binding : function->bindings) {
    binding->reachable = true;
    entry_bindings_.insert(binding);
    if (binding->is_ordered && entry.stage != ir::kStagePixel) {
      report_stage_use({binding->location, binding->name, ir::kStagePixel, false}, entry.stage,
                       entry.name);
    }
  }
  entry.uses_view_heap = entry.uses_view_heap || function->uses_view_heap;
  entry.uses_sampler_heap = entry.uses_sampler_heap || function->uses_sampler_heap;
  for (VariableInfo* global : function->globals) {
    if (!globals.insert(global->variable->id).second) continue;
    entry_globals_.push_back(global);
    if (global->initialiser_facts) {
      mark_reachable(global->initialiser_facts.get(), entry, mark, globals);
    }
  }
  for (FunctionInfo* callee : function->callees) mark_reachable(callee, entry, mark, globals);
}

// Root signatures bind what exported functions use, for libraries that will be linked.
void Checker::mark_bindings(FunctionInfo* function, uint32_t mark) {
  if (function->visit_mark == mark) return;
  function->visit_mark = mark;
  for (BindingInfo* binding : function->bindings) binding->reachable = true;
  for (FunctionInfo* callee : function->callees) mark_bindings(callee, mark);
}

void Checker::finish(ir::Module& module) {
  // Facts propagate from callees to callers, which works because callees were lowered first.
  for (FunctionInfo* function : lower_.lowered_functions_) {
    std::sort(function->callees.begin(), function->callees.end());
    function->callees.erase(std::unique(function->callees.begin(), function->callees.end()),
                            function->callees.end());
    ir::Function* node = function->ir;
    node->may_trace = function->traces;
    node->uses_query = function->queries;
    node->may_call = function->calls_shader;
    node->may_end_shader = function->ends_shader;
    node->has_barrier = function->has_barrier;
    for (const FunctionInfo* callee : function->callees) {
      if (!callee->ir) continue;
      node->may_trace |= callee->ir->may_trace;
      node->uses_query |= callee->ir->uses_query;
      node->may_call |= callee->ir->may_call;
      node->may_end_shader |= callee->ir->may_end_shader;
      node->has_barrier |= callee->ir->has_barrier;
    }
  }
  std::set<VariableInfo*> all_globals;
  std::vector<std::set<BindingInfo*>> bindings_of(module.entry_points.size());
  std::set<const ir::Function*> started, run;
  std::vector<std::pair<FunctionInfo*, FunctionInfo*>> initialisers;  // entry point, what it runs
  uint32_t mark = 0;
  for (const auto& [function, index] : entries_) {
    ir::EntryPoint& entry = module.entry_points[index];
    entry_bindings_.clear();
    entry_globals_.clear();
    entry.imports = imports_of(function);
    std::set<uint32_t> globals;
    mark_reachable(function, entry, ++mark, globals);
    bindings_of[index] = entry_bindings_;
    for (size_t i = 0; i < library_functions_.size(); ++i) {
      if (library_functions_[i]->visit_mark != mark) continue;
      module.library_functions[i].callers.push_back(static_cast<uint32_t>(index));
    }
    if (!entry.imports.empty()) continue;
    run.insert(entry.function);
    std::sort(entry_globals_.begin(), entry_globals_.end(),
              [](const VariableInfo* a, const VariableInfo* b) {
                return a->variable->id < b->variable->id;
              });
    // Initialisers that call functions run at the very start of the shader.
    ir::Block start;
    for (VariableInfo* global : entry_globals_) {
      all_globals.insert(global);
      if (global->initialiser_facts)
        initialisers.push_back({function, global->initialiser_facts.get()});
      start.insert(start.end(), global->start_up.begin(), global->start_up.end());
    }
    if (!start.empty() && started.insert(function->ir).second) {
      ir::Block& body = function->ir->body;
      body.insert(body.begin(), start.begin(), start.end());
    }
  }
  for (size_t i = 0; i < library_functions_.size(); ++i) {
    mark_bindings(library_functions_[i], ++mark);
    module.library_functions[i].imports = imports_of(library_functions_[i]);
  }
  finish_waves(initialisers);
  for (const auto& [wrapper, function, stage] : wrappers_) {
    wrapper->stages = stage;
    wrapper->may_trace = function->ir->may_trace;
    wrapper->uses_query = function->ir->uses_query;
    wrapper->may_call = function->ir->may_call;
    wrapper->may_end_shader = function->ir->may_end_shader;
    wrapper->has_barrier = function->ir->has_barrier;
    wrapper->has_waves = function->ir->has_waves;
  }
  for (FunctionInfo* function : lower_.lowered_functions_) {
    if (function->ir->stages != 0) module.functions.push_back(function->ir);
  }
  for (const Wrapper& one : wrappers_) {
    if (run.count(one.function)) module.functions.push_back(one.function);
  }
  for (VariableInfo& variable : variables_) {
    if (variable.kind == VariableKind::kGlobal && all_globals.count(&variable)) {
      module.globals.push_back(variable.variable);
    }
  }
  make_pixel_functions();
  assign_registers();
  for (size_t i = 0; i < bindings_of.size(); ++i) {
    for (const BindingInfo* binding : bindings_of[i]) {
      module.entry_points[i].bindings.push_back(binding->index);
    }
    std::sort(module.entry_points[i].bindings.begin(), module.entry_points[i].bindings.end());
  }
  check_overlaps();
  collect_structs();
}

// Where only ray and vertex shaders come, a wave is one lane; everywhere else its statements stay.
void Checker::finish_waves(
    const std::vector<std::pair<FunctionInfo*, FunctionInfo*>>& initialisers) {
  const auto keep = [this](FunctionInfo& function) {
    const bool stays = (function.stages & (ir::kStageCompute | ir::kStagePixel)) != 0;
    if (!stays) {
      for (ir::Stmt* wave : function.waves) lower_.make_wave_lone(*wave);
      function.waves.clear();
    }
    return !function.waves.empty();
  };
  for (FunctionInfo* function : lower_.lowered_functions_) {
    function->ir->has_waves = keep(*function);
    for (const FunctionInfo* callee : function->callees) {
      if (callee->ir) function->ir->has_waves |= callee->ir->has_waves;
    }
  }
  for (const auto& [entry, initialiser] : initialisers) {
    bool waits = keep(*initialiser);
    for (const FunctionInfo* callee : initialiser->callees) {
      waits = waits || (callee->ir && callee->ir->has_waves);
    }
    entry->ir->has_waves = entry->ir->has_waves || waits;
  }
}

void Checker::collect_struct(const ir::Type* type) {
  if (!type) return;
  if (type->kind == ir::TypeKind::kArray || type->kind == ir::TypeKind::kResource) {
    collect_struct(type->element);
    return;
  }
  if (type->kind != ir::TypeKind::kStruct) return;
  if (!collected_structs_.insert(type->structure).second) return;
  for (const ir::Field& field : type->structure->fields) collect_struct(field.type);
  module_->structs.push_back(type->structure);
}

void Checker::collect_structs_of(const ir::Expr* expression) {
  if (!expression || !collected_exprs_.insert(expression).second) return;
  collect_struct(expression->type);
  for (const ir::Expr* operand : expression->operands) collect_structs_of(operand);
}

void Checker::collect_structs_of(const ir::Block& body) {
  for (const ir::Stmt* statement : body) {
    if (statement->variable) collect_struct(statement->variable->type);
    collect_structs_of(statement->place);
    collect_structs_of(statement->value);
    collect_structs_of(statement->compare);
    for (const ir::Expr* operand : statement->operands) collect_structs_of(operand);
    for (const ir::Expr* argument : statement->arguments) collect_structs_of(argument);
    collect_structs_of(statement->prelude);
    collect_structs_of(statement->body);
    collect_structs_of(statement->orelse);
    collect_structs_of(statement->step);
    for (const ir::SwitchCase& one : statement->cases) collect_structs_of(one.body);
  }
}

void Checker::collect_structs() {
  collect_struct(ray_desc_->type->ir);
  for (const ir::Function* function : module_->functions) {
    collect_struct(function->result);
    for (const ir::Variable* parameter : function->parameters) collect_struct(parameter->type);
    collect_structs_of(function->body);
  }
  for (const ir::Variable* global : module_->globals) {
    collect_struct(global->type);
    collect_structs_of(global->initialiser);
  }
  for (const ir::Binding& binding : module_->bindings) collect_struct(binding.type);
  for (const ir::EntryPoint& entry : module_->entry_points) {
    collect_struct(entry.payload);
    collect_struct(entry.attributes);
  }
}

void Checker::warn_skipped() {
  size_t count = 0;
  std::string names;
  SourceLocation first;
  for (const FunctionInfo& function : functions_) {
    const bool skipped = function.definition && !function.is_template &&
                         function.template_suffix.empty() &&
                         function.state == FunctionInfo::State::kPending;
    // It is normal that a library does not use everything in the files it includes.
    if (!skipped || sources_.include_location(function.definition->location).is_valid()) continue;
    if (count == 0) first = function.definition->location;
    if (count < kNamesShown) names += (count ? ", " : "") + function.qualified;
    ++count;
  }
  if (count == 0) return;
  if (count > kNamesShown) names += ", ..";
  report(CheckId::kSkipped, first, {std::to_string(count), names});
}

}  // namespace kaamos::hlsl
