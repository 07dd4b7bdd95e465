// SPDX-License-Identifier: MIT
//
// Everything that is declared.
#pragma once

#include <cstdint>
#include <deque>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "runtime/hlsl/builder/finish/finish_module.h"
#include "runtime/hlsl/check/names/options.h"
#include "runtime/hlsl/check/names/scopes.h"
#include "runtime/hlsl/check/names/symbols.h"
#include "runtime/hlsl/check/names/workbench.h"

namespace kaamos::hlsl {

struct Program {
  Program(const CheckOptions& own, const Link* linked, const SourceManager& sources,
          DiagnosticEngine& diagnostics)
      : bench(sources, diagnostics), scopes(bench.messages), link(linked) {
    set_options(&own);
    global = scopes.make_scope(ScopeKind::kGlobal, nullptr);
    unit_scopes = {global};
  }

  // The options of the unit whose code is being checked.
  void set_options(const CheckOptions* of_unit) {
    options = of_unit;
    bench.messages.set_strict(options->strict);
  }
  void enter_unit(uint32_t unit) {
    if (link) set_options(&link->units[unit].options);
  }

  Workbench bench;
  Scopes scopes;
  const Link* link;  // null: a library by itself
  const CheckOptions* options = nullptr;

  Scope* global = nullptr;  // of the unit that is being declared
  std::vector<Scope*> unit_scopes;
  std::deque<VariableInfo> variables;
  std::deque<FunctionInfo> functions;
  std::deque<StructInfo> structs;
  std::deque<EnumInfo> enums;
  std::deque<StructTemplate> struct_templates;
  std::deque<BindingInfo> bindings;
  std::vector<FunctionInfo*> all_functions;  // in declaration order, without templates
  std::unordered_map<const Decl*, const Type*> declared_types;
  std::unordered_map<const StructInfo*, std::pair<StructTemplate*, TemplateValues>>
      instance_arguments;
  StructInfo* ray_desc = nullptr;
  StructInfo* hit_object = nullptr;          // null before Shader Model 6.9
  StructInfo* triangle_positions = nullptr;  // null before Shader Model 6.10
  ModuleFacts facts;
};

}  // namespace kaamos::hlsl
