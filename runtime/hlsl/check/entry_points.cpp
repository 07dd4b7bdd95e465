// SPDX-License-Identifier: MIT
// Entry points, their signatures, and what a library exports. [DXR: Shader stages]
#include <algorithm>
#include <cctype>

#include "runtime/hlsl/analysis/checked_access.h"
#include "runtime/hlsl/check/checker.h"
#include "runtime/hlsl/check/mangle.h"

namespace kaamos::hlsl {
namespace {

bool same_word(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return std::tolower(static_cast<unsigned char>(x)) ==
                  std::tolower(static_cast<unsigned char>(y));
         });
}

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
    {"pixel", ir::kStagePixel},
};
constexpr std::string_view kOtherStages[] = {"geometry", "hull",          "domain",
                                             "mesh",     "amplification", "node"};

}  // namespace

const Attribute* find_attribute(const FunctionInfo& function, std::string_view name) {
  for (const FunctionDecl* decl : {function.decl, function.definition}) {
    if (!decl) continue;
    if (const Attribute* found = find_attribute(decl->attributes, name)) return found;
  }
  return nullptr;
}

const Attribute* find_attribute(std::span<const Attribute> attributes, std::string_view name) {
  for (const Attribute& attribute : attributes) {
    if (attribute.scope.empty() && same_word(attribute.name, name)) return &attribute;
  }
  return nullptr;
}

bool Checker::has_stage(const FunctionInfo& function) {
  return find_attribute(function, "shader") != nullptr;
}

// Returns 0 if there is none.
uint32_t Checker::stage_attribute(FunctionInfo* function) {
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

std::vector<std::string> Checker::export_names(const FunctionInfo* function) {
  if (options_->exports.empty()) return {std::string(function->name)};
  std::vector<std::string> names;
  for (const ExportRequest& request : options_->exports) {
    const bool is_meant =
        request.function == function->name || request.function == function->qualified ||
        (!function->signature_failed && !function->is_template &&
         (request.function == mangle(*function) || "\01" + request.function == mangle(*function)));
    if (is_meant) names.insert(names.end(), request.names.begin(), request.names.end());
  }
  return names;
}

void Checker::find_entry_points() {
  const bool is_library = options_->target.starts_with("lib");
  if (!is_library) {
    FunctionInfo* kernel = nullptr;
    for (FunctionInfo* function : all_functions_) {
      if (function->definition && !function->owner && function->name == options_->entry_point) {
        kernel = function;
      }
    }
    if (!kernel) {
      report(CheckId::kNoEntryPoint, {}, {options_->entry_point});
      return;
    }
    const uint32_t stage = options_->target.starts_with("vs")   ? ir::kStageVertex
                           : options_->target.starts_with("ps") ? ir::kStagePixel
                                                                : ir::kStageCompute;
    check_entry_point(kernel, stage, options_->entry_point);
    return;
  }
  // By index, because lowering a body may declare more methods (of local structs).
  for (size_t i = 0; i < all_functions_.size(); ++i) {
    FunctionInfo* function = all_functions_[i];
    if (!function->definition || function->scope->unit != 0) continue;
    const uint32_t stage = stage_attribute(function);
    if (stage == 0) continue;
    for (const std::string& name : export_names(function)) {
      if (link_ &&
          std::find(link_->entries.begin(), link_->entries.end(), name) == link_->entries.end()) {
        continue;
      }
      check_entry_point(function, stage, name);
    }
  }
}

void Checker::check_entry_point(FunctionInfo* function, uint32_t stage, const std::string& name) {
  const SourceLocation location = function->definition->location;
  for (const ir::EntryPoint& other : module_->entry_points) {
    if (other.name == name) {
      report(CheckId::kDuplicateExport, location, {name});
      return;
    }
  }
  if (function->owner || function->signature_failed) {
    if (function->owner) report(CheckId::kEntryIsMethod, location, {function->qualified});
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
  // The body is checked even if the signature is wrong, so that one run reports all errors.
  lower_.lower_function(function, location);
  const bool parameters = stage == ir::kStageCompute ? check_compute_parameters(function, entry)
                          : entry.is_graphics()      ? check_graphics_signature(function, entry)
                                                     : check_ray_parameters(function, entry);
  if (const Attribute* attribute = find_attribute(*function, "rootsignature")) {
    const auto* text =
        attribute->arguments.size() == 1 ? as<StringLiteralExpr>(attribute->arguments[0]) : nullptr;
    if (text) entry.root_signature = std::string(text->value);
    if (!text) {
      report(CheckId::kRootSignatureAttribute, attribute->location,
             {attribute->arguments.size() == 1
                  ? "another expression"
                  : std::to_string(attribute->arguments.size()) + " arguments"});
    }
  }
  if (!valid || !parameters || !function->ir) return;
  if (!entry.function) entry.function = function->ir;
  if (stage != ir::kStageCompute && stage != ir::kStageCallable && !entry.is_graphics())
    lower_.wrap_payload(function, entry);
  facts_.entries.push_back({function, module_->entry_points.size()});
  module_->entry_points.push_back(std::move(entry));
}

bool Checker::check_ray_parameters(FunctionInfo* function, ir::EntryPoint& entry) {
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
    if (!parameter.type->is_struct() || contains_resource(parameter.type)) {
      report(CheckId::kEntryStruct, location,
             {std::string(role), shader, to_string(parameter.type)});
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
    if (stage != ir::kStageCallable) check_payload_use(parameter.type, location);
  }
  return valid;
}

bool Checker::read_thread_group(FunctionInfo* function, ir::EntryPoint& entry) {
  const Attribute* attribute = find_attribute(*function, "numthreads");
  const SourceLocation location = function->definition->location;
  if (!attribute) {
    report(CheckId::kNoThreadGroup, location, {entry.name});
    return false;
  }
  if (attribute->arguments.size() != 3) {
    report(CheckId::kArgumentCount, attribute->location,
           {"numthreads", "3", std::to_string(attribute->arguments.size())});
    return false;
  }
  static constexpr int64_t kLimits[] = {1024, 1024, 64};
  int64_t product = 1;
  for (size_t i = 0; i < 3; ++i) {
    const auto size =
        constant_integer(attribute->arguments[i], function->scope, "a size of numthreads");
    if (!size) return false;
    if (*size < 1 || *size > kLimits[i]) {
      report(CheckId::kThreadGroup, attribute->arguments[i]->location,
             {std::string(1, "XYZ"[i]), std::to_string(*size), std::to_string(kLimits[i])});
      return false;
    }
    entry.thread_group[i] = static_cast<uint32_t>(*size);
    product *= *size;
  }
  if (product > 1024) {
    report(CheckId::kThreadGroup, attribute->location, {"X*Y*Z", std::to_string(product), "1024"});
    return false;
  }
  return read_wave_size(function, entry);
}

// [WaveSize(lanes)] or [WaveSize(least, most, preferred)].
bool Checker::read_wave_size(FunctionInfo* function, ir::EntryPoint& entry) {
  const Attribute* attribute = find_attribute(*function, "WaveSize");
  if (!attribute) return true;
  const size_t count = attribute->arguments.size();
  const uint32_t needs = count == 1 ? 6 : 8;
  if (count < 1 || count > 3) {
    report(CheckId::kWaveSizeRange, attribute->location, {std::to_string(count) + " values"});
    return false;
  }
  if (shader_model_minor(options_->target) < needs) {
    report(CheckId::kWaveShaderModel, attribute->location,
           {count == 1 ? "[WaveSize]" : "[WaveSize] with a range", "6." + std::to_string(needs),
            options_->target});
    return false;
  }
  uint32_t lanes[3] = {};
  for (size_t i = 0; i < count; ++i) {
    const auto size = constant_integer(attribute->arguments[i], function->scope, "a wave's size");
    if (!size) return false;
    if (*size < 4 || *size > 128 || (*size & (*size - 1)) != 0) {
      report(CheckId::kWaveSize, attribute->arguments[i]->location, {std::to_string(*size)});
      return false;
    }
    lanes[i] = static_cast<uint32_t>(*size);
  }
  entry.least_wave_lanes = lanes[0];
  entry.most_wave_lanes = count == 1 ? lanes[0] : lanes[1];
  const bool ascend = lanes[0] <= entry.most_wave_lanes;
  const bool prefers = count < 3 || (lanes[0] <= lanes[2] && lanes[2] <= lanes[1]);
  if (ascend && prefers) return true;
  report(CheckId::kWaveSizeRange, attribute->location,
         {ascend ? "a preferred size out of its range" : "more lanes at least than at most"});
  return false;
}

// System values may be of any integer type, split into parts, or fields of a struct: a wrapper
// takes them in their native types and passes them on.
bool Checker::check_compute_parameters(FunctionInfo* function, ir::EntryPoint& entry) {
  bool valid = read_thread_group(function, entry);
  struct Source {
    std::string_view semantic;
    ir::EntryParameter parameter;
    uint32_t size;
  };
  static constexpr Source kSources[] = {
      {"SV_DispatchThreadID", ir::EntryParameter::kDispatchThreadId, 3},
      {"SV_GroupID", ir::EntryParameter::kGroupId, 3},
      {"SV_GroupThreadID", ir::EntryParameter::kGroupThreadId, 3},
      {"SV_GroupIndex", ir::EntryParameter::kGroupIndex, 1},
  };
  if (!function->ir) return false;
  ir::Function* wrapper = make_wrapper(*module_, build_, *function->ir);
  wrapper->mangled = function->ir->mangled + "#entry";
  Lowerer::BodyScope body(lower_, nullptr, &wrapper->body, function->scope);
  at(function->definition->location);
  bool plain = true;
  const auto value_of = [&](const Type* type, const Semantic* semantic, SourceLocation location,
                            std::string_view name) -> const ir::Expr* {
    if (!semantic) {
      report(CheckId::kMissingSemantic, location, {std::string(name), entry.name});
      return nullptr;
    }
    for (const Source& source : kSources) {
      if (!same_word(semantic->base, source.semantic)) continue;
      const Type* own = types_.vector(Scalar::kUint32, source.size);
      const bool fits = type->is_numeric() && !type->is_matrix() && is_integer(type->scalar) &&
                        type->components() <= source.size;
      if (!fits) {
        report(CheckId::kSemanticType, location,
               {std::string(semantic->text), to_string(own), to_string(type)});
        return nullptr;
      }
      plain = plain && same_type(type, own);
      ir::Variable* variable = build_.variable(std::string(name), own->ir, ir::Storage::kParameter);
      wrapper->parameters.push_back(variable);
      entry.parameters.push_back(source.parameter);
      return lower_.convert_numeric(build_.read(variable), own, type);
    }
    report(CheckId::kUnknownSemantic, semantic->location,
           {std::string(semantic->text), entry.name});
    return nullptr;
  };
  std::vector<const ir::Expr*> arguments;
  for (const ParameterInfo& parameter : function->parameters) {
    const SourceLocation location = parameter.decl->location;
    if (parameter.is_out) {
      report(CheckId::kEntryModifier, location,
             {std::string(parameter.name), "compute shader '" + entry.name + "'", "in"});
      valid = false;
      continue;
    }
    const ir::Expr* argument = nullptr;
    if (parameter.type->is_struct() && !parameter.type->structure->base) {
      plain = false;
      std::vector<const ir::Expr*> parts;
      bool complete = true;
      for (const FieldInfo& field : parameter.type->structure->fields) {
        const Semantic* semantic = field.decl ? field.decl->annotations.semantic : nullptr;
        const ir::Expr* part = value_of(field.type, semantic, location, field.name);
        complete = complete && part;
        parts.push_back(part);
      }
      if (complete) argument = build_.construct(parameter.type->ir, std::move(parts));
    } else {
      argument =
          value_of(parameter.type, parameter.decl->annotations.semantic, location, parameter.name);
    }
    valid = valid && argument;
    arguments.push_back(argument);
  }
  if (!valid || plain) return valid;
  ir::Stmt* call_statement = build_.stmt(ir::StmtKind::kCall);
  call_statement->function = function->ir;
  call_statement->arguments = std::move(arguments);
  wrapper->body.push_back(call_statement);
  facts_.wrappers.push_back({wrapper, function, ir::kStageCompute});
  entry.function = wrapper;
  return true;
}

void Checker::add_library_functions() {
  for (const Exported& exported : exported_functions(0)) {
    FunctionInfo* const function = exported.function;
    lower_.lower_function(function, function->definition->location);
    if (!function->ir) continue;
    module_->library_functions.push_back(
        {exported.name, exported.mangled, lower_.describe(*function), {}, {}});
    facts_.library_functions.push_back(function);
  }
  for (const ExportRequest& request : options_->exports) {
    const bool found =
        std::any_of(request.names.begin(), request.names.end(), [&](const std::string& name) {
          const auto& entries = module_->entry_points;
          const auto& functions = module_->library_functions;
          return std::any_of(entries.begin(), entries.end(),
                             [&](const ir::EntryPoint& entry) { return entry.name == name; }) ||
                 std::any_of(functions.begin(), functions.end(),
                             [&](const ir::LibraryFunction& one) { return one.name == name; });
        });
    if (!found && !has_errors()) report(CheckId::kExportNotFound, {}, {request.function});
  }
}

}  // namespace kaamos::hlsl
