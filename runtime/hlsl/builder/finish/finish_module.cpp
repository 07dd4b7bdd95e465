// SPDX-License-Identifier: MIT
#include "runtime/hlsl/builder/finish/finish_module.h"

#include <algorithm>
#include <set>
#include <utility>

#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/builder/finish/lone_lane.h"
#include "runtime/hlsl/builder/finish/quad_functions.h"
#include "runtime/hlsl/builder/finish/registers.h"
#include "runtime/hlsl/builder/finish/square_quads.h"

namespace kaamos::hlsl {
namespace {

// An initialiser that runs when an entry point starts.
struct StartedInitialiser {
  FunctionFacts* entry;
  FunctionFacts* initialiser;
};

// Marks what one entry point reaches, and checks that its stage may reach it.
class EntryReach {
 public:
  EntryReach(ir::EntryPoint& entry, uint32_t mark, FinishReport& report)
      : entry_(entry), mark_(mark), report_(report) {}

  std::set<BindingFacts*> bindings;
  std::vector<GlobalFacts*> globals;
  bool quads = false;

  void mark(FunctionFacts* function) {
    if (function->visit_mark == mark_) return;
    function->visit_mark = mark_;
    if (entry_.imports.empty()) {
      function->stages |= entry_.stage;
      if (function->ir) function->ir->stages |= entry_.stage;
    }
    quads = quads || reads_quads(*function);
    entry_.attribute_bytes = std::max(entry_.attribute_bytes, function->reported_bytes);
    entry_.attribute_type = joined_type(entry_.attribute_type, function->reported_type);
    for (const StageUse& use : function->stage_uses) {
      if ((use.stages & entry_.stage) == 0) {
        report_.stage_use(use, entry_);
      } else if (entry_.stage == ir::kStageCompute && !has_quads(entry_) &&
                 (use.is_derivative || use.is_implicit_level)) {
        report_.no_quads(use, entry_);
      }
    }
    for (BindingFacts* binding : function->bindings) {
      binding->reachable = true;
      bindings.insert(binding);
      if (binding->is_ordered && entry_.stage != ir::kStagePixel) {
        report_.stage_use(
            {.place = binding->place, .name = binding->name, .stages = ir::kStagePixel}, entry_);
      }
    }
    entry_.uses_view_heap = entry_.uses_view_heap || function->uses_view_heap;
    entry_.uses_sampler_heap = entry_.uses_sampler_heap || function->uses_sampler_heap;
    for (GlobalFacts* global : function->globals) {
      if (!ids_.insert(global->variable->id).second) continue;
      globals.push_back(global);
      if (global->initialiser) mark(global->initialiser);
    }
    for (FunctionFacts* callee : function->callees) mark(callee);
  }

 private:
  ir::EntryPoint& entry_;
  const uint32_t mark_;
  FinishReport& report_;
  std::set<uint32_t> ids_;  // of `globals`
};

// Root signatures bind what exported functions use, for libraries that will be linked.
void mark_bindings(FunctionFacts* function, uint32_t mark) {
  if (function->visit_mark == mark) return;
  function->visit_mark = mark;
  for (BindingFacts* binding : function->bindings) binding->reachable = true;
  for (FunctionFacts* callee : function->callees) mark_bindings(callee, mark);
}

// Facts propagate from callees to callers, which works because callees were lowered first.
void propagate(const std::vector<FunctionFacts*>& functions) {
  for (FunctionFacts* function : functions) {
    std::sort(function->callees.begin(), function->callees.end());
    function->callees.erase(std::unique(function->callees.begin(), function->callees.end()),
                            function->callees.end());
    ir::Function* node = function->ir;
    node->may_trace = function->traces;
    node->uses_query = function->queries;
    node->uses_hit_object = function->hit_objects;
    node->may_call = function->calls_shader;
    node->may_end_shader = function->ends_shader;
    node->has_barrier = function->has_barrier;
    for (const FunctionFacts* callee : function->callees) {
      if (!callee->ir) continue;
      node->may_trace |= callee->ir->may_trace;
      node->uses_query |= callee->ir->uses_query;
      node->uses_hit_object |= callee->ir->uses_hit_object;
      node->may_call |= callee->ir->may_call;
      node->may_end_shader |= callee->ir->may_end_shader;
      node->has_barrier |= callee->ir->has_barrier;
    }
  }
}

// Where only ray and vertex shaders come, a wave is one lane; everywhere else its statements stay.
void finish_waves(IrBuilder& build, const std::vector<FunctionFacts*>& functions,
                  const std::vector<StartedInitialiser>& initialisers) {
  const auto keep = [&](FunctionFacts& function) {
    const bool stays = (function.stages & (ir::kStageCompute | ir::kStagePixel)) != 0;
    if (!stays) {
      for (ir::Stmt* wave : function.waves) make_wave_lone(build, *wave);
      function.waves.clear();
    }
    return !function.waves.empty();
  };
  for (FunctionFacts* function : functions) {
    function->ir->has_waves = keep(*function);
    for (const FunctionFacts* callee : function->callees) {
      if (callee->ir) function->ir->has_waves |= callee->ir->has_waves;
    }
  }
  for (const auto& [entry, initialiser] : initialisers) {
    bool waits = keep(*initialiser);
    for (const FunctionFacts* callee : initialiser->callees) {
      waits = waits || (callee->ir && callee->ir->has_waves);
    }
    entry->ir->has_waves = entry->ir->has_waves || waits;
  }
}

// Module::structs: those that are used, members before users.
class StructCollector {
 public:
  explicit StructCollector(ir::Module& module) : module_(module) {}

  void run() {
    add(module_.ray_desc);
    for (const ir::Function* function : module_.functions) {
      add(function->result);
      for (const ir::Variable* parameter : function->parameters) add(parameter->type);
      add(function->body);
    }
    for (const ir::Variable* global : module_.globals) {
      add(global->type);
      add(global->initialiser);
    }
    for (const ir::Binding& binding : module_.bindings) add(binding.type);
    for (const ir::EntryPoint& entry : module_.entry_points) {
      add(entry.payload);
      add(entry.attributes);
    }
  }

 private:
  void add(const ir::Struct* structure) {
    if (!structs_.insert(structure).second) return;
    for (const ir::Field& field : structure->fields) add(field.type);
    module_.structs.push_back(structure);
  }

  void add(const ir::Type* type) {
    if (!type) return;
    if (type->kind == ir::TypeKind::kArray || type->kind == ir::TypeKind::kResource) {
      add(type->element);
    } else if (type->kind == ir::TypeKind::kStruct) {
      add(type->structure);
    }
  }

  void add(const ir::Expr* expression) {
    if (!expression || !exprs_.insert(expression).second) return;
    add(expression->type);
    for (const ir::Expr* operand : expression->operands) add(operand);
  }

  void add(const ir::Block& body) {
    for (const ir::Stmt* statement : body) {
      if (statement->variable) add(statement->variable->type);
      add(statement->place);
      add(statement->value);
      add(statement->compare);
      for (const ir::Expr* operand : statement->operands) add(operand);
      for (const ir::Expr* argument : statement->arguments) add(argument);
      add(statement->prelude);
      add(statement->body);
      add(statement->orelse);
      add(statement->step);
      for (const ir::SwitchCase& one : statement->cases) add(one.body);
    }
  }

  ir::Module& module_;
  std::set<const ir::Struct*> structs_;
  std::set<const ir::Expr*> exprs_;
};

void collect_imports(const FunctionFacts* function, std::set<const FunctionFacts*>& visited,
                     std::vector<uint32_t>& imports) {
  if (!visited.insert(function).second) return;
  if (function->is_import) imports.push_back(function->import_index);
  for (const FunctionFacts* callee : function->callees) collect_imports(callee, visited, imports);
}

}  // namespace

std::vector<uint32_t> imports_of(const ir::Module& module, const FunctionFacts& function) {
  std::vector<uint32_t> imports;
  std::set<const FunctionFacts*> visited;
  if (!module.imports.empty()) collect_imports(&function, visited, imports);
  std::sort(imports.begin(), imports.end());
  return imports;
}

void set_aside_unlinked(ir::Module& module) {
  std::vector<ir::EntryPoint> linked;
  std::vector<uint32_t> new_index(module.entry_points.size());
  for (const bool runs : {true, false}) {
    for (size_t i = 0; i < new_index.size(); ++i) {
      ir::EntryPoint& entry = module.entry_points[i];
      if (entry.imports.empty() != runs) continue;
      auto& list = runs ? linked : module.unlinked_entry_points;
      new_index[i] = static_cast<uint32_t>(list.size() + (runs ? 0 : linked.size()));
      list.push_back(entry);
    }
  }
  module.entry_points = std::move(linked);
  for (ir::LibraryFunction& function : module.library_functions) {
    for (uint32_t& caller : function.callers) caller = new_index[caller];
    std::sort(function.callers.begin(), function.callers.end());
  }
}

void finish_module(ir::Module& module, IrBuilder& build, ModuleFacts& facts, FinishReport& report) {
  propagate(facts.functions);
  std::set<const GlobalFacts*> all_globals;
  std::vector<std::set<BindingFacts*>> bindings_of(module.entry_points.size());
  std::set<const ir::Function*> started, run;
  std::vector<StartedInitialiser> initialisers;
  std::vector<ir::EntryPoint*> square;
  uint32_t mark = 0;
  for (const auto& [function, index] : facts.entries) {
    ir::EntryPoint& entry = module.entry_points[index];
    entry.imports = imports_of(module, *function);
    EntryReach reach(entry, ++mark, report);
    reach.mark(function);
    bindings_of[index] = reach.bindings;
    if (reach.quads && facts.square_quads && has_square_quads(entry) && entry.imports.empty()) {
      square.push_back(&entry);
    }
    for (size_t i = 0; i < facts.library_functions.size(); ++i) {
      if (facts.library_functions[i]->visit_mark != mark) continue;
      module.library_functions[i].callers.push_back(static_cast<uint32_t>(index));
    }
    if (!entry.imports.empty()) continue;
    run.insert(entry.function);
    std::sort(reach.globals.begin(), reach.globals.end(),
              [](const GlobalFacts* a, const GlobalFacts* b) {
                return a->variable->id < b->variable->id;
              });
    report.reached(reach.globals, entry);
    // Initialisers that call functions run at the very start of the shader.
    ir::Block start;
    for (const GlobalFacts* global : reach.globals) {
      all_globals.insert(global);
      if (global->initialiser) initialisers.push_back({function, global->initialiser});
      start.insert(start.end(), global->start_up.begin(), global->start_up.end());
    }
    if (!start.empty() && started.insert(function->ir).second) {
      ir::Block& body = function->ir->body;
      body.insert(body.begin(), start.begin(), start.end());
    }
  }
  for (size_t i = 0; i < facts.library_functions.size(); ++i) {
    mark_bindings(facts.library_functions[i], ++mark);
    module.library_functions[i].imports = imports_of(module, *facts.library_functions[i]);
  }
  finish_waves(build, facts.functions, initialisers);
  for (const auto& [wrapper, function, stage] : facts.wrappers) {
    wrapper->stages = stage;
    wrapper->may_trace = function->ir->may_trace;
    wrapper->uses_query = function->ir->uses_query;
    wrapper->uses_hit_object = function->ir->uses_hit_object;
    wrapper->may_call = function->ir->may_call;
    wrapper->may_end_shader = function->ir->may_end_shader;
    wrapper->has_barrier = function->ir->has_barrier;
    wrapper->has_waves = function->ir->has_waves;
  }
  for (const FunctionFacts* function : facts.functions) {
    if (function->ir->stages != 0) module.functions.push_back(function->ir);
  }
  for (const ModuleFacts::Wrapper& one : facts.wrappers) {
    if (run.count(one.function)) module.functions.push_back(one.function);
  }
  // Before expressions are copied, of which bindings know only the first.
  assign_registers(module, facts, report);
  for (ir::EntryPoint* entry : square) make_quads_square(module, build, *entry);
  for (const GlobalFacts* global : facts.globals) {
    if (all_globals.count(global)) module.globals.push_back(global->variable);
  }
  make_quad_functions(module, build, facts, report.has_errors());
  for (size_t i = 0; i < bindings_of.size(); ++i) {
    for (const BindingFacts* binding : bindings_of[i]) {
      module.entry_points[i].bindings.push_back(binding->index);
    }
    std::sort(module.entry_points[i].bindings.begin(), module.entry_points[i].bindings.end());
  }
  check_overlaps(module, facts, report);
  StructCollector(module).run();
}

}  // namespace kaamos::hlsl
