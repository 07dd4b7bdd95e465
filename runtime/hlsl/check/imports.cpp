// SPDX-License-Identifier: MIT
// Functions without a body: what a library by itself knows of them, and their definitions where
// several libraries are linked.
#include <algorithm>

#include "runtime/hlsl/check/checker.h"
#include "runtime/hlsl/check/mangle.h"

namespace kaamos::hlsl {
namespace {

bool same_fields(const ir::Struct& one, const ir::Struct& other) {
  return std::equal(one.fields.begin(), one.fields.end(), other.fields.begin(), other.fields.end(),
                    [](const ir::Field& a, const ir::Field& b) {
                      return a.type == b.type && a.row_major == b.row_major;
                    });
}

}  // namespace

void Checker::enter_unit(uint32_t unit) {
  if (link_) options_ = &link_->units[unit].options;
}

// What a library exports that is not an entry point. [-default-linkage external, -exports]
std::vector<Checker::Exported> Checker::exported_functions(uint32_t unit) {
  const CheckOptions* const before = options_;
  enter_unit(unit);
  const bool everything =
      options_->target == "lib_6_x" || options_->external_linkage || !options_->exports.empty();
  std::vector<Exported> exported;
  for (FunctionInfo* function : all_functions_) {
    if (function->scope->unit != unit || !function->definition || function->is_static ||
        function->owner || function->signature_failed || !(everything || function->is_exported) ||
        has_stage(*function)) {
      continue;
    }
    for (const std::string& name : export_names(function)) {
      std::vector<MangledParameter> parameters;
      for (const ParameterInfo& parameter : function->parameters) {
        parameters.push_back({parameter.type, parameter.is_out && parameter.type->is_numeric()});
      }
      // Renaming an export changes the name inside the mangled one, too.
      const std::string qualified = name == function->name ? function->qualified : name;
      exported.push_back({name, mangle(qualified, function->result, parameters), function});
    }
  }
  options_ = before;
  return exported;
}

// Libraries that are linked often include one header. Its structs are the same type in all of them.
void Checker::reuse_struct(StructInfo* info) {
  if (!link_) return;
  const auto [first, last] = structs_by_name_.equal_range(info->name);
  for (auto at = first; at != last; ++at) {
    const StructInfo& other = *at->second;
    if (other.scope->unit == info->scope->unit || !same_fields(*other.ir, *info->ir)) continue;
    types_.share(info, other);
    return;
  }
  structs_by_name_.emplace(info->name, info);
}

bool Checker::is_importable(const FunctionInfo& function) const {
  return options_->target.starts_with("lib") && !function.is_static && !function.owner &&
         !function.is_template && function.template_suffix.empty();
}

FunctionInfo* Checker::linked_definition(const FunctionInfo& import) {
  const std::string name = mangle(import);
  for (const Link::Definition& one : link_->definitions) {
    if (one.unit != import.scope->unit || one.import != name) continue;
    for (const Exported& exported : exported_functions(one.from)) {
      if (exported.mangled == one.definition) return exported.function;
    }
  }
  return nullptr;
}

// Mangled names leave out what a struct holds, and whether one is passed back.
bool Checker::same_signatures(const FunctionInfo& import, const FunctionInfo& definition,
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
  report_with_notes(
      CheckId::kLinkedTypes, use,
      {lower_.describe(import), link_->units[import.scope->unit].options.name,
       lower_.describe(definition), link_->units[definition.scope->unit].options.name, difference},
      {{import.decl->location, "declared here"},
       {definition.definition->location, "defined here"}});
  return false;
}

// Gives a function without a body its IR: that of its definition in another library, or, in a
// library by itself, an empty one.
void Checker::make_import(FunctionInfo* function, SourceLocation use) {
  if (function->signature_failed) return;
  if (link_) {
    FunctionInfo* const definition = linked_definition(*function);
    if (!definition) {
      report_with_notes(CheckId::kNoBody, use, {lower_.describe(*function)},
                        {{function->decl->location, "declared here"}});
      return;
    }
    if (!same_signatures(*function, *definition, use)) return;
    lower_.lower_function(definition, use);
    function->linked = definition;
    function->ir = definition->ir;
    if (definition->ir) function->state = FunctionInfo::State::kDone;
    return;
  }
  for (const ParameterInfo& parameter : function->parameters) {
    if (!parameter.is_unbounded()) continue;
    report(CheckId::kImportParameter, use,
           {lower_.describe(*function), std::string(parameter.name)});
    return;
  }
  function->state = FunctionInfo::State::kDone;
  function->is_import = true;
  function->ir = lower_.make_ir_function(function);
  function->import_index = static_cast<uint32_t>(module_->imports.size());
  module_->imports.push_back({function->qualified, mangle(*function), lower_.describe(*function)});
}

// [DXC: static global initializers]
void Checker::check_initialiser_imports(const VariableInfo& variable) {
  if (!variable.initialiser) return;
  const std::vector<uint32_t> imports = imports_of(*module_, *variable.initialiser);
  if (imports.empty()) return;
  report(CheckId::kInitialiserImport, variable.decl->location,
         {std::string(variable.name), module_->imports[imports[0]].signature});
}

// A library by itself has given its resources registers, which root signatures rely on.
void Checker::assign_known_registers() {
  for (BindingInfo& binding : bindings_) {
    if (binding.has_register) continue;
    for (const LinkedUnit::Register& known : link_->units[binding.unit].registers) {
      if (known.binding != binding.name) continue;
      binding.register_index = known.index;
      binding.space = known.space;
      binding.has_register = binding.has_space = binding.is_automatic = true;
      break;
    }
  }
}

}  // namespace kaamos::hlsl
