// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/exports.h"

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/attributes.h"
#include "runtime/hlsl/check/names/mangle.h"

namespace kaamos::hlsl {

bool Exports::has_stage(const FunctionInfo& function) {
  return find_attribute(function, "shader") != nullptr;
}

std::vector<std::string> Exports::export_names(const FunctionInfo* function) {
  if (program_.options->exports.empty()) return {std::string(function->name)};
  std::vector<std::string> names;
  for (const ExportRequest& request : program_.options->exports) {
    std::string_view wanted = request.function;
    // DXC and reflection print the mangled name's first byte as `\01`.
    if (wanted.starts_with("\\01?")) wanted.remove_prefix(3);
    if (wanted.starts_with("\01?")) wanted.remove_prefix(1);
    const bool is_meant = wanted == function->name || wanted == function->qualified ||
                          (!function->signature_failed && !function->is_template &&
                           "\01" + std::string(wanted) == mangle(*function));
    if (is_meant) names.insert(names.end(), request.names.begin(), request.names.end());
  }
  return names;
}

// Returns what a library exports that is not an entry point. [-default-linkage external, -exports]
std::vector<Exported> Exports::exported_functions(uint32_t unit) {
  const CheckOptions* const before = program_.options;
  program_.enter_unit(unit);
  const bool everything = program_.options->target == "lib_6_x" ||
                          program_.options->external_linkage || !program_.options->exports.empty();
  std::vector<Exported> exported;
  for (FunctionInfo* function : program_.all_functions) {
    if (function->scope->unit != unit || !function->definition || function->is_static ||
        function->owner || function->signature_failed || !(everything || function->is_exported) ||
        has_stage(*function) ||
        std::any_of(function->parameters.begin(), function->parameters.end(),
                    [](const ParameterInfo& parameter) { return parameter.is_unsized(); })) {
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
  program_.set_options(before);
  return exported;
}

}  // namespace kaamos::hlsl
