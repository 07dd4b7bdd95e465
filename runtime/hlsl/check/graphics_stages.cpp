// SPDX-License-Identifier: MIT
// Vertex and pixel shaders, which are checked like others but of which no code is made.
#include <algorithm>
#include <cctype>

#include "runtime/hlsl/check/checker.h"

namespace kaamos::hlsl {
namespace {

constexpr std::string_view kPixelOutputs[] = {
    "SV_Target",         "SV_Depth",    "SV_DepthGreaterEqual",
    "SV_DepthLessEqual", "SV_Coverage", "SV_StencilRef"};

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

}  // namespace

void Checker::check_graphics_value(const GraphicsValue& value, const GraphicsEntry& entry) {
  if (value.semantic) {
    const bool is_pixel_output = value.is_output && entry.stage == ir::kStagePixel;
    const bool is_known = std::any_of(
        std::begin(kPixelOutputs), std::end(kPixelOutputs),
        [&](std::string_view known) { return same_letters(known, value.semantic->base); });
    if (is_pixel_output && !is_known) {
      report(CheckId::kPixelOutput, value.semantic->location,
             {std::string(value.semantic->text), entry.name});
    }
    return;
  }
  if (!value.type->is_struct()) {
    report(CheckId::kGraphicsSemantic, value.location,
           {std::string(value.name), std::string(stage_name(entry.stage)), entry.name});
    return;
  }
  for (const StructInfo* info = value.type->structure; info; info = info->base) {
    for (const FieldInfo& field : info->fields) {
      if (!field.decl || field.type->is_error()) continue;
      check_graphics_value({field.type, field.decl->annotations.semantic, field.decl->location,
                            field.name, value.is_output},
                           entry);
    }
  }
}

void Checker::check_graphics_entry(FunctionInfo* function, uint32_t stage,
                                   const std::string& name) {
  const SourceLocation location = function->definition->location;
  if (function->owner || function->signature_failed) {
    if (function->owner) report(CheckId::kEntryIsMethod, location, {function->qualified});
    return;
  }
  lower_.lower_function(function, location);
  const GraphicsEntry entry = {function, stage, name};
  for (const ParameterInfo& parameter : function->parameters) {
    // uniform parameters are constants.
    if (!parameter.decl || (parameter.decl->modifiers & kModUniform) != 0) continue;
    check_graphics_value({parameter.type, parameter.decl->annotations.semantic,
                          parameter.decl->location, parameter.name, parameter.is_out},
                         entry);
  }
  if (!function->result->is_void()) {
    const Semantic* semantic = function->definition->annotations.semantic;
    if (!semantic) semantic = function->decl->annotations.semantic;
    check_graphics_value({function->result, semantic, location, "the result", true}, entry);
  }
  graphics_entries_.push_back(entry);
  report(CheckId::kNoCodeForStage, location, {name, std::string(stage_name(stage))});
}

void Checker::check_graphics_uses() {
  for (const GraphicsEntry& entry : graphics_entries_) {
    std::set<const FunctionInfo*> seen;
    std::vector<FunctionInfo*> reached = {entry.function};
    while (!reached.empty()) {
      FunctionInfo* function = reached.back();
      reached.pop_back();
      if (!seen.insert(function).second) continue;
      for (const StageUse& use : function->stage_uses) {
        const bool is_wave = use.name.starts_with("Wave") || use.name.starts_with("Quad");
        if ((use.stages & entry.stage) == 0 && !is_wave) {
          report_stage_use(use, entry.stage, entry.name);
        }
      }
      reached.insert(reached.end(), function->callees.begin(), function->callees.end());
      for (VariableInfo* global : function->globals) {
        if (global->initialiser_facts) reached.push_back(global->initialiser_facts.get());
      }
    }
  }
}

void Checker::report_stage_use(const StageUse& use, uint32_t stage, const std::string& name) {
  if (!reported_uses_.insert({use.location.raw, stage}).second) return;
  if (use.is_implicit_level) {
    report(CheckId::kImplicitLevel, use.location, {std::string(use.name)});
    return;
  }
  report(CheckId::kStage, use.location,
         {std::string(use.name), stage_list(use.stages), std::string(stage_name(stage)), name});
}

}  // namespace kaamos::hlsl
