// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/graphics_stages.h"

#include <algorithm>
#include <utility>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/attributes.h"
#include "runtime/hlsl/check/stages/graphics_signature.h"

namespace kaamos::hlsl {
bool GraphicsStages::check_graphics_signature(FunctionInfo* function, ir::EntryPoint& entry) {
  if (!function->ir) return false;
  const SourceLocation location = function->definition->location;
  ir::Function* wrapper = make_wrapper(bench_.module, build_, *function->ir);
  // The export keeps the name that DXC gives it.
  std::string& mangled = function->ir->mangled;
  if (mangled.ends_with("#body")) mangled.resize(mangled.size() - 5);
  wrapper->mangled = mangled;
  mangled += "#body";
  BodyScope body(lower_, nullptr, &wrapper->body, function->scope);
  at(location);
  const bool is_pixel = entry.stage == ir::kStagePixel;
  const bool is_geometry = entry.stage == ir::kStageGeometry;
  if (is_geometry && !geometry_.read_attributes(*function, entry)) return false;
  const ir::Type* flag = build_.scalar_type(Scalar::kBool);
  const auto flag_parameter = [&](const char* name, ir::ParameterMode mode) {
    ir::Variable* variable = build_.variable(name, flag, ir::Storage::kParameter);
    variable->mode = mode;
    return variable;
  };
  ir::Variable* is_live = is_pixel ? flag_parameter("is_live", ir::ParameterMode::kIn) : nullptr;
  const ir::Variable* live = is_pixel ? live_variable() : nullptr;
  if (is_pixel) lower_.body.assign(live, build_.read(is_live));
  if (!read_waves_of_helpers(*function, entry)) return false;
  GraphicsSignature inputs(program_, lower_, entry, false, *wrapper, live);
  GraphicsSignature outputs(program_, lower_, entry, true, *wrapper, live);
  outputs.inputs = &inputs;
  const auto name_of_value = [](const Semantic* semantic) {
    return GraphicsSignature::Name{semantic, semantic ? semantic->index : 0};
  };

  ir::Stmt* call = build_.stmt(ir::StmtKind::kCall);
  call->function = function->ir;
  struct Output {
    const Type* type;
    GraphicsSignature::Name name;
    GraphicsSignature::Source source;
    const ir::Variable* variable;
  };
  std::vector<Output> results;
  if (!function->result->is_void()) {
    const Semantic* semantic = function->definition->annotations.semantic;
    if (!semantic) semantic = function->decl->annotations.semantic;
    ir::Variable* result = lower_.body.empty_temporary(function->result->ir);
    call->result = result;
    results.push_back({function->result, name_of_value(semantic), {location, "result"}, result});
  }
  for (const ParameterInfo& parameter : function->parameters) {
    if (!parameter.decl) continue;
    const Modifiers modifiers = parameter.decl->modifiers;
    const GraphicsSignature::Source source = {parameter.decl->location, parameter.name, modifiers};
    const Semantic* semantic = parameter.decl->annotations.semantic;
    if (modifiers & kModUniform) {
      report(CheckId::kUnsupported, source.location,
             {"'" + std::string(parameter.name) + "' (a uniform parameter of an entry point)"});
      return false;
    }
    if (is_geometry && parameter.type->is_stream()) {
      if (!geometry_.take_stream(parameter, entry)) return false;
      outputs.describe_vertex(parameter.type->structure->stream_vertex, source);
      call->arguments.push_back(build_.read(lower_.body.empty_temporary(parameter.type->ir)));
      continue;
    }
    if (is_geometry && (modifiers & kModPrimitive) != 0) {
      if (!geometry_.take_primitive(parameter, entry)) return false;
      call->arguments.push_back(inputs.read_corners(parameter.type, name_of_value(semantic), source,
                                                    call->arguments.size()));
      continue;
    }
    const ir::Expr* value = nullptr;
    if (parameter.is_in) {
      GraphicsSignature::Name name = name_of_value(semantic);
      value = inputs.read(parameter.type, name, source, call->arguments.size());
    }
    if (parameter.is_out) {
      ir::Variable* variable = lower_.body.empty_temporary(parameter.type->ir);
      if (value) lower_.body.assign(variable, value);
      value = build_.read(variable);
      results.push_back({parameter.type, name_of_value(semantic), source, variable});
    }
    call->arguments.push_back(value);
  }
  if (is_geometry && !inputs.failed && !outputs.failed &&
      !geometry_.check_shape(*function, outputs.elements, entry)) {
    return false;
  }
  if (!inputs.failed) inputs.check_limits(location);
  if (is_pixel && !inputs.failed) inputs.read_inputs(*function);
  if (is_pixel && bench_.sample_count && !inputs.failed) {
    function->globals.push_back(bench_.sample_count);
    lower_.body.assign(bench_.sample_count->variable, inputs.sample_count());
  }
  if (const ir::Variable* thread = lower_.printing.thread(); thread && !inputs.failed) {
    lower_.printing.use_thread(*function);
    lower_.body.assign(thread, inputs.thread(thread->type));
  }
  function->is_pixel_entry = function->is_pixel_entry || is_pixel;
  lower_.body.emit(call);
  for (Output& output : results) {
    outputs.write(output.type, output.name, output.source, build_.read(output.variable));
  }
  if (!outputs.failed) outputs.check_limits(location);
  entry.parameters.assign(inputs.elements.size(), ir::EntryParameter::kInput);
  if (!is_geometry) {
    entry.parameters.resize(entry.parameters.size() + outputs.elements.size(),
                            ir::EntryParameter::kOutput);
  }
  if (is_pixel) {
    wrapper->parameters.push_back(is_live);
    ir::Variable* stays = flag_parameter("stays_live", ir::ParameterMode::kOut);
    wrapper->parameters.push_back(stays);
    lower_.body.assign(stays, build_.read(live));
    entry.parameters.push_back(ir::EntryParameter::kIsLive);
    entry.parameters.push_back(ir::EntryParameter::kStaysLive);
  }
  entry.inputs = std::move(inputs.elements);
  entry.outputs = std::move(outputs.elements);
  if (inputs.failed || outputs.failed) return false;
  if (find_attribute(*function, "earlydepthstencil")) {
    entry.graphics_flags |= shader::kGraphicsEarlyDepthStencil;
  }
  program_.facts.wrappers.push_back({wrapper, function, entry.stage});
  entry.function = wrapper;
  return true;
}

// [WaveOpsIncludeHelperLanes]
bool GraphicsStages::read_waves_of_helpers(const FunctionInfo& function,
                                           const ir::EntryPoint& entry) {
  const Attribute* attribute = find_attribute(function, "WaveOpsIncludeHelperLanes");
  if (!attribute || entry.stage != ir::kStagePixel) return true;
  if (shader_model_minor(program_.options->target) < 7) {
    report(CheckId::kWaveShaderModel, attribute->location,
           {"[WaveOpsIncludeHelperLanes]", "6.7", program_.options->target});
    return false;
  }
  ir::Variable*& variable = program_.facts.waves_of_helpers;
  if (!variable) {
    variable = build_.variable("waves_of_helpers", build_.scalar_type(Scalar::kBool),
                               ir::Storage::kStaticGlobal);
  }
  lower_.body.assign(variable, build_.boolean(true));
  return true;
}

const ir::Variable* GraphicsStages::live_variable() {
  if (!program_.facts.live) {
    program_.facts.live =
        build_.variable("live", build_.scalar_type(Scalar::kBool), ir::Storage::kStaticGlobal);
  }
  return program_.facts.live;
}

}  // namespace kaamos::hlsl
