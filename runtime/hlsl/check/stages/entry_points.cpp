// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/entry_points.h"

#include <algorithm>
#include <cctype>

#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/builder/finish/finish_module.h"
#include "runtime/hlsl/builder/payload_access.h"
#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/attributes.h"
#include "runtime/hlsl/check/names/layout.h"
#include "runtime/hlsl/check/names/signatures.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {
namespace {

struct StageWord {
  std::string_view word;
  uint32_t stage;
};
constexpr StageWord kStageWords[] = {
    {"raygeneration", ir::kStageRayGeneration},
    {"intersection", ir::kStageIntersection},
    {"anyhit", ir::kStageAnyHit},
    {"closesthit", ir::kStageClosestHit},
    {"miss", ir::kStageMiss},
    {"callable", ir::kStageCallable},
    {"compute", ir::kStageCompute},
    {"vertex", ir::kStageVertex},
    {"geometry", ir::kStageGeometry},
    {"pixel", ir::kStagePixel},
};
constexpr std::string_view kOtherStages[] = {"hull", "domain", "mesh", "amplification", "node"};

}  // namespace

// Returns 0 if there is none.
uint32_t EntryPoints::stage_attribute(FunctionInfo* function) {
  const Attribute* attribute = find_attribute(*function, "shader");
  if (!attribute) return 0;
  const auto* word =
      attribute->arguments.size() == 1 ? as<StringLiteralExpr>(attribute->arguments[0]) : nullptr;
  if (!word) {
    report(CheckId::kShaderAttribute, attribute->location, {"nothing"});
    return 0;
  }
  for (const StageWord& one : kStageWords) {
    if (word->value == one.word) return one.stage;
  }
  for (const std::string_view other : kOtherStages) {
    if (word->value == other) {
      report(CheckId::kSkippedStage, attribute->location,
             {std::string(function->name), std::string(other)});
      return 0;
    }
  }
  report(CheckId::kShaderAttribute, attribute->location, {"\"" + std::string(word->value) + "\""});
  return 0;
}

void EntryPoints::find_entry_points() {
  const bool is_library = program_.options->target.starts_with("lib");
  if (!is_library) {
    FunctionInfo* kernel = nullptr;
    for (FunctionInfo* function : program_.all_functions) {
      if (function->definition && !function->owner &&
          function->name == program_.options->entry_point) {
        kernel = function;
      }
    }
    if (!kernel) {
      report(CheckId::kNoEntryPoint, {}, {program_.options->entry_point});
      return;
    }
    const uint32_t stage = program_.options->target.starts_with("vs")   ? ir::kStageVertex
                           : program_.options->target.starts_with("gs") ? ir::kStageGeometry
                           : program_.options->target.starts_with("ps") ? ir::kStagePixel
                                                                        : ir::kStageCompute;
    check_entry_point(kernel, stage, program_.options->entry_point);
    return;
  }
  // By index, because lowering a body may declare more methods (of local structs).
  for (size_t i = 0; i < program_.all_functions.size(); ++i) {
    FunctionInfo* function = program_.all_functions[i];
    if (!function->definition || function->scope->unit != 0) continue;
    const uint32_t stage = stage_attribute(function);
    if (stage == 0) continue;
    for (const std::string& name : exports_.export_names(function)) {
      if (program_.link && std::find(program_.link->entries.begin(), program_.link->entries.end(),
                                     name) == program_.link->entries.end()) {
        continue;
      }
      check_entry_point(function, stage, name);
    }
  }
}

void EntryPoints::check_entry_point(FunctionInfo* function, uint32_t stage,
                                    const std::string& name) {
  const SourceLocation location = function->definition->location;
  for (const ir::EntryPoint& other : bench_.module.entry_points) {
    if (other.name == name) {
      report(CheckId::kDuplicateExport, location, {name});
      return;
    }
  }
  if (function->owner || function->signature_failed) {
    if (function->owner) report(CheckId::kEntryIsMethod, location, {function->qualified});
    if (function->other_stage) lower_.names.resolve_type(function->other_stage, function->scope);
    return;
  }
  ir::EntryPoint entry;
  entry.name = name;
  entry.stage = stage;
  bool valid = true;
  if (!function->result->is_void() && !entry.is_graphics()) {
    report(CheckId::kEntryResult, location,
           {std::string(stage_name(stage)), name, to_string(function->result)});
    valid = false;
  }
  if (const Attribute* attribute = find_attribute(*function, "numthreads");
      attribute && stage != ir::kStageCompute) {
    report(CheckId::kIgnoredInStage, attribute->location,
           {"numthreads", std::string(stage_name(stage))});
  }
  // The body is checked even if the signature is wrong, so that one run reports all errors.
  lower_.calls.lower_function(function, location);
  const bool parameters =
      stage == ir::kStageCompute ? compute_.check_compute_parameters(function, entry)
      : entry.is_graphics()      ? graphics_.check_graphics_signature(function, entry)
                                 : check_ray_parameters(function, entry);
  if (const Attribute* attribute = find_attribute(*function, "rootsignature")) {
    const auto* text =
        attribute->arguments.size() == 1 ? as<StringLiteralExpr>(attribute->arguments[0]) : nullptr;
    if (text) entry.root_signature = std::string(text->value);
    if (stage != ir::kStageCompute && !entry.is_graphics()) {
      report(CheckId::kRootSignatureStage, attribute->location, {std::string(stage_name(stage))});
    }
    if (!text) {
      report(CheckId::kRootSignatureAttribute, attribute->location,
             {attribute->arguments.size() == 1
                  ? "another expression"
                  : std::to_string(attribute->arguments.size()) + " arguments"});
    }
  }
  if (!valid || !parameters || !function->ir) return;
  if (!entry.function) entry.function = function->ir;
  if (stage != ir::kStageCompute && !entry.is_graphics()) name_thread(*function);
  if (stage != ir::kStageCompute && stage != ir::kStageCallable && !entry.is_graphics())
    wrap_payload(function, entry);
  program_.facts.entries.push_back({function, bench_.module.entry_points.size()});
  bench_.module.entry_points.push_back(std::move(entry));
}

// printf says which thread it comes from.
void EntryPoints::name_thread(FunctionInfo& function) {
  const ir::Variable* thread = lower_.printing.thread();
  if (!thread) return;
  lower_.printing.use_thread(function);
  ir::Expr* index = build_.expr(ir::ExprKind::kSystemValue, thread->type);
  index->system_value = ir::SystemValue::kDispatchRaysIndex;
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kAssign);
  statement->place = build_.read(thread);
  statement->value = index;
  function.ir->body.insert(function.ir->body.begin(), statement);
}

bool EntryPoints::check_ray_parameters(FunctionInfo* function, ir::EntryPoint& entry) {
  const uint32_t stage = entry.stage;
  const std::string shader = std::string(stage_name(stage)) + " shader '" + entry.name + "'";
  const bool hits = stage == ir::kStageClosestHit || stage == ir::kStageAnyHit;
  const size_t expected = hits ? 2 : stage == ir::kStageMiss || stage == ir::kStageCallable ? 1 : 0;
  const std::string needed = hits                          ? "an inout payload and in attributes"
                             : stage == ir::kStageMiss     ? "an inout payload"
                             : stage == ir::kStageCallable ? "an inout parameter"
                                                           : "none";
  if (function->parameters.size() != expected) {
    report(CheckId::kEntryParameters, function->definition->location,
           {shader, std::to_string(expected), needed, std::to_string(function->parameters.size())});
    return false;
  }
  bool valid = true;
  for (size_t i = 0; i < expected; ++i) {
    const ParameterInfo& parameter = function->parameters[i];
    const SourceLocation location = parameter.decl->location;
    const std::string_view role = i == 1                        ? "attributes"
                                  : stage == ir::kStageCallable ? "parameter"
                                                                : "payload";
    if (!parameter.type->is_struct() || contains_resource(parameter.type) ||
        contains_hit_object(parameter.type)) {
      report(CheckId::kEntryStruct, location,
             {std::string(role), shader, to_string(parameter.type)});
      valid = false;
      continue;
    }
    if (contains_long_vector(parameter.type)) {
      report(CheckId::kLongVectorPlace, location,
             {"the parameters of an entry point", to_string(parameter.type)});
      valid = false;
      continue;
    }
    const bool by_reference = parameter.is_in && parameter.is_out;
    if (i == 0 ? !by_reference : parameter.is_out) {
      report(CheckId::kEntryModifier, location,
             {std::string(role), shader, i == 0 ? "inout" : "in"});
      valid = false;
      continue;
    }
    const uint32_t bytes = payload_bytes(parameter.type);
    if (i == 1) {
      entry.parameters.push_back(ir::EntryParameter::kAttributes);
      entry.attributes = parameter.type->ir;
      entry.attribute_bytes = bytes;
      entry.attribute_type = type_hash(entry.attributes);
      if (bytes > 32) {
        report(CheckId::kAttributeSize, location,
               {to_string(parameter.type), std::to_string(bytes)});
        valid = false;
      }
      continue;
    }
    entry.parameters.push_back(stage == ir::kStageCallable ? ir::EntryParameter::kCallableData
                                                           : ir::EntryParameter::kPayload);
    entry.payload = parameter.type->ir;
    entry.payload_bytes = bytes;
    if (stage != ir::kStageCallable) lower_.names.check_payload_use(parameter.type, location);
  }
  return valid;
}

void EntryPoints::add_library_functions() {
  for (const Exported& exported : exports_.exported_functions(0)) {
    FunctionInfo* const function = exported.function;
    const bool has_resources =
        contains_resource(function->result) ||
        std::any_of(function->parameters.begin(), function->parameters.end(),
                    [](const ParameterInfo& one) { return contains_resource(one.type); });
    if (has_resources && program_.options->target != "lib_6_x") {
      report(CheckId::kExportedResource, function->definition->location, {function->qualified});
    }
    lower_.calls.lower_function(function, function->definition->location);
    if (!function->ir) continue;
    bench_.module.library_functions.push_back(
        {exported.name, exported.mangled, describe(*function), {}, {}});
    program_.facts.library_functions.push_back(function);
  }
  for (const ExportRequest& request : program_.options->exports) {
    const bool found =
        std::any_of(request.names.begin(), request.names.end(), [&](const std::string& name) {
          const auto& entries = bench_.module.entry_points;
          const auto& functions = bench_.module.library_functions;
          return std::any_of(entries.begin(), entries.end(),
                             [&](const ir::EntryPoint& entry) { return entry.name == name; }) ||
                 std::any_of(functions.begin(), functions.end(),
                             [&](const ir::LibraryFunction& one) { return one.name == name; });
        });
    if (!found && !messages_.has_errors()) report(CheckId::kExportNotFound, {}, {request.function});
  }
}

// The source's entry point becomes an ordinary function; the new entry point makes the working copy
// and calls it.
void EntryPoints::wrap_payload(FunctionInfo* function, ir::EntryPoint& entry) {
  if (!function->ir || function->parameters.empty()) return;
  const StructInfo& structure = *function->parameters[0].type->structure;
  if (!structure.is_payload) return;
  entry.unbounded_payload = !program_.options->target.ends_with("6_6");
  const uint8_t stage = payload_stage_of(entry.stage);
  const PayloadLeaves leaves = payload_leaves(structure);
  if (all_access(leaves, stage)) return;
  for (const ModuleFacts::Wrapper& one : program_.facts.wrappers) {
    if (one.wrapped == function) {
      entry.function = one.function;
      return;
    }
  }
  const ir::Location before = build_.location;
  at(function->definition->location);
  ir::Function* wrapper = make_payload_wrapper(bench_.module, build_, function->ir, leaves, stage);
  build_.location = before;
  program_.facts.wrappers.push_back({wrapper, function, entry.stage});
  entry.function = wrapper;
}

}  // namespace kaamos::hlsl
