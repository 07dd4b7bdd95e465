// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/imports.h"

#include <algorithm>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/mangle.h"
#include "runtime/hlsl/check/names/signatures.h"

namespace kaamos::hlsl {

bool Imports::is_importable(const FunctionInfo& function) const {
  return program_.options->target.starts_with("lib") && !function.is_static && !function.owner &&
         !function.is_template && function.template_suffix.empty();
}

FunctionInfo* Imports::linked_definition(const FunctionInfo& import) {
  const std::string name = mangle(import);
  for (const Link::Definition& one : program_.link->definitions) {
    if (one.unit != import.scope->unit || one.import != name) continue;
    for (const Exported& exported : exports_.exported_functions(one.from)) {
      if (exported.mangled == one.definition) return exported.function;
    }
  }
  return nullptr;
}

// Mangled names leave out what a struct holds, and whether one is passed back.
bool Imports::same_signatures(const FunctionInfo& import, const FunctionInfo& definition,
                              SourceLocation use) {
  std::string difference;
  if (import.result->ir != definition.result->ir) {
    difference = "their results '" + to_string(import.result) + "' have other members";
  }
  for (size_t i = 0; i < import.parameters.size() && difference.empty(); ++i) {
    const ParameterInfo& a = import.parameters[i];
    const ParameterInfo& b = definition.parameters[i];
    const std::string parameter = "parameter " + std::to_string(i + 1);
    if (a.is_out != b.is_out) {
      difference = "only one passes " + parameter + " back";
    } else if (a.type->ir != b.type->ir) {
      difference = parameter + " '" + to_string(a.type) + "' has other members";
    }
  }
  if (difference.empty()) return true;
  messages_.report_with_notes(
      CheckId::kLinkedTypes, use,
      {describe(import), program_.link->units[import.scope->unit].options.name,
       describe(definition), program_.link->units[definition.scope->unit].options.name, difference},
      {{import.decl->location, "declared here"},
       {definition.definition->location, "defined here"}});
  return false;
}

// Gives a function without a body its IR: that of its definition in another library, or, in a
// library by itself, an empty one.
void Imports::make_import(FunctionInfo* function, SourceLocation use) {
  if (function->signature_failed) return;
  if (program_.link) {
    FunctionInfo* const definition = linked_definition(*function);
    if (!definition) {
      messages_.report_with_notes(CheckId::kNoBody, use, {describe(*function)},
                                  {{function->decl->location, "declared here"}});
      return;
    }
    if (!same_signatures(*function, *definition, use)) return;
    lower_.calls.lower_function(definition, use);
    function->linked = definition;
    function->ir = definition->ir;
    if (definition->ir) function->state = FunctionInfo::State::kDone;
    return;
  }
  for (const ParameterInfo& parameter : function->parameters) {
    if (!parameter.is_unbounded()) continue;
    report(CheckId::kImportParameter, use, {describe(*function), std::string(parameter.name)});
    return;
  }
  function->state = FunctionInfo::State::kDone;
  function->is_import = true;
  function->ir = lower_.calls.make_ir_function(function);
  function->import_index = static_cast<uint32_t>(bench_.module.imports.size());
  bench_.module.imports.push_back({function->qualified, mangle(*function), describe(*function)});
}

}  // namespace kaamos::hlsl
