// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/compute_stage.h"

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/attributes.h"

namespace kaamos::hlsl {

bool ComputeStage::read_thread_group(FunctionInfo* function, ir::EntryPoint& entry) {
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
        lower_.constant_integer(attribute->arguments[i], function->scope, "a size of numthreads");
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
  return read_groupshared_limit(function, entry) && read_wave_size(function, entry);
}

// [GroupSharedLimit(bytes)]
bool ComputeStage::read_groupshared_limit(FunctionInfo* function, ir::EntryPoint& entry) {
  constexpr std::string_view kName = "GroupSharedLimit";
  const Attribute* attribute = find_attribute(*function, kName);
  if (!attribute) return true;
  if (shader_model_minor(program_.options->target) < 10) {
    report(CheckId::kNeedsShaderModel, attribute->location, {"[GroupSharedLimit]", "6.10"});
    return false;
  }
  if (attribute->arguments.size() != 1) {
    report(CheckId::kArgumentCount, attribute->location,
           {std::string(kName), "1", std::to_string(attribute->arguments.size())});
    return false;
  }
  const auto bytes = lower_.constant_integer(attribute->arguments[0], function->scope,
                                             "a limit of groupshared memory");
  if (!bytes) return false;
  if (*bytes < 0 || *bytes > UINT32_MAX) {
    report(CheckId::kGroupsharedLimit, attribute->arguments[0]->location, {std::to_string(*bytes)});
    return false;
  }
  entry.groupshared_limit = static_cast<uint32_t>(*bytes);
  return true;
}

// [WaveSize(lanes)] or [WaveSize(least, most, preferred)].
bool ComputeStage::read_wave_size(FunctionInfo* function, ir::EntryPoint& entry) {
  const Attribute* attribute = find_attribute(*function, "WaveSize");
  for (const Attribute& other : function->definition->attributes) {
    if (attribute && &other != attribute && same_word(other.name, "WaveSize")) {
      report(CheckId::kAttributeTwice, other.location, {"WaveSize"});
    }
  }
  if (!attribute) return true;
  const size_t count = attribute->arguments.size();
  const uint32_t needs = count == 1 ? 6 : 8;
  if (count < 1 || count > 3) {
    report(CheckId::kWaveSizeRange, attribute->location, {std::to_string(count) + " values"});
    return false;
  }
  if (shader_model_minor(program_.options->target) < needs) {
    report(CheckId::kWaveShaderModel, attribute->location,
           {count == 1 ? "[WaveSize]" : "[WaveSize] with a range", "6." + std::to_string(needs),
            program_.options->target});
    return false;
  }
  uint32_t lanes[3] = {};
  for (size_t i = 0; i < count; ++i) {
    const auto size =
        lower_.constant_integer(attribute->arguments[i], function->scope, "a wave's size");
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
bool ComputeStage::check_compute_parameters(FunctionInfo* function, ir::EntryPoint& entry) {
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
  ir::Function* wrapper = make_wrapper(bench_.module, build_, *function->ir);
  wrapper->mangled = function->ir->mangled + "#entry";
  BodyScope body(lower_, nullptr, &wrapper->body, function->scope);
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
      return lower_.conversions.convert_numeric(build_.read(variable), own, type);
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
  if (const ir::Variable* thread = lower_.printing.thread()) {
    plain = false;
    lower_.printing.use_thread(*function);
    ir::Variable* id = build_.variable("thread", thread->type, ir::Storage::kParameter);
    wrapper->parameters.push_back(id);
    entry.parameters.push_back(ir::EntryParameter::kDispatchThreadId);
    lower_.body.assign(thread, build_.read(id));
  }
  if (!valid || plain) return valid;
  ir::Stmt* call_statement = build_.stmt(ir::StmtKind::kCall);
  call_statement->function = function->ir;
  call_statement->arguments = std::move(arguments);
  wrapper->body.push_back(call_statement);
  program_.facts.wrappers.push_back({wrapper, function, ir::kStageCompute});
  entry.function = wrapper;
  return true;
}

}  // namespace kaamos::hlsl
