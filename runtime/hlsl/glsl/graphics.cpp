// SPDX-License-Identifier: MIT
//
// Inputs and outputs of vertex, geometry and pixel shaders, as kaamos/shader/spirv_interface.h has
// them.
#include <algorithm>

#include "kaamos/shader/spirv_interface.h"
#include "runtime/hlsl/glsl/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

std::string vector_type(const SignatureElement& element) {
  constexpr Scalar kScalars[] = {Scalar::kFloat32, Scalar::kInt32, Scalar::kUint32};
  return glsl::vector_name(kScalars[static_cast<size_t>(element.type)], element.components);
}

// Points have one pixel. It counts as an output, of which there may be 32 vectors; drivers take
// what is not written as 1.
bool writes_point_size(const EntryPoint& entry) {
  constexpr size_t kMostVectors = 32;
  const bool may_be_points = entry.stage == kStageVertex ||
                             (entry.stage == kStageGeometry && entry.geometry.output_corners == 1);
  return may_be_points && entry.outputs.size() < kMostVectors;
}

std::string component_of(const SignatureElement& element, const std::string& name, int index) {
  return element.components == 1 ? name : name + "." + glsl::component(index);
}

}  // namespace

// What EvaluateAttribute* reads of a declared input, which is one location with it; empty for other
// inputs.
std::string GlslEmitter::at_other_place(size_t index) {
  const SignatureElement& element = entry_.inputs[index];
  if (!element.is_implied || shader::is_flat(element.interpolation)) return "";
  for (size_t i = 0; i < index; ++i) {
    const SignatureElement& declared = entry_.inputs[i];
    if (declared.is_implied || declared.semantic_index != element.semantic_index ||
        declared.semantic != element.semantic) {
      continue;
    }
    const std::string name = "g_in_" + std::to_string(i);
    return shader::is_at_centroid(element.interpolation)
               ? "interpolateAtCentroid(" + name + ")"
               : "interpolateAtOffset(" + name + ", vec2(0.0))";
  }
  return "";
}

// Declares the variable of an input and returns its value, of the element's type.
std::string GlslEmitter::graphics_input(size_t index) {
  const SignatureElement& element = entry_.inputs[index];
  const std::string type = vector_type(element);
  if (entry_.function->parameters[index]->type->kind == TypeKind::kArray) {
    return corner_inputs(index);
  }
  switch (element.system_value) {
    case shader::SystemValue::kGeometryInstance:
      return type + "(gl_InvocationID)";
    case shader::SystemValue::kVertexId:
      return type + "(gl_VertexIndex - gl_BaseVertex)";
    case shader::SystemValue::kInstanceId:
      return type + "(gl_InstanceIndex - gl_BaseInstance)";
    case shader::SystemValue::kStartVertexLocation:
      return type + "(gl_BaseVertex)";
    case shader::SystemValue::kStartInstanceLocation:
      return type + "(gl_BaseInstance)";
    case shader::SystemValue::kPrimitiveId:
      return type + (entry_.stage == kStageGeometry ? "(gl_PrimitiveIDIn)" : "(gl_PrimitiveID)");
    case shader::SystemValue::kIsFrontFace:
      // As a number, all bits. [D3D11.3: 15.12]
      return type + "(gl_FrontFacing ? -1 : 0)";
    case shader::SystemValue::kPosition:
      // Where the shader runs for each sample, gl_FragCoord is that of the sample.
      if ((entry_.graphics_flags & shader::kGraphicsRunsPerSample) != 0 &&
          !shader::is_at_sample(element.interpolation)) {
        return "vec4(floor(gl_FragCoord.xy) + 0.5, gl_FragCoord.z, 1.0 / gl_FragCoord.w)";
      }
      return "vec4(gl_FragCoord.xyz, 1.0 / gl_FragCoord.w)";
    case shader::SystemValue::kCoverage:
      // Drivers need not clear the mask of helpers.
      return type + "(gl_HelperInvocation ? 0 : gl_SampleMaskIn[0])";
    case shader::SystemValue::kSampleIndex:
      return type + "(gl_SampleID)";
    case shader::SystemValue::kSampleCount:
      return type + "(" + sample_count() + ")";
    default:
      break;
  }
  if (const std::string value = at_other_place(index); !value.empty()) return value;
  const std::string name = "g_in_" + std::to_string(index);
  std::string mode;
  if (entry_.stage == kStagePixel) {
    const shader::Interpolation interpolation = element.interpolation;
    if (shader::is_flat(interpolation)) mode = "flat ";
    if (shader::is_no_perspective(interpolation)) mode = "noperspective ";
    if (shader::is_at_centroid(interpolation)) mode += "centroid ";
    if (shader::is_at_sample(interpolation)) mode += "sample ";
  }
  declarations_ += "layout(location = " + std::to_string(index) + ") " + mode + "in " + type + " " +
                   name + ";\n";
  return name;
}

// An element for each corner.
std::string GlslEmitter::corner_inputs(size_t index) {
  const SignatureElement& element = entry_.inputs[index];
  const std::string name = "g_in_" + std::to_string(index);
  declarations_ += "layout(location = " + std::to_string(index) + ") in " + vector_type(element) +
                   " " + name + "[];\n";
  std::string out = type(entry_.function->parameters[index]->type) + "(";
  for (uint32_t corner = 0; corner < entry_.geometry.corners; ++corner) {
    out += (corner == 0 ? "" : ", ") + name + "[" + std::to_string(corner) + "]";
  }
  return out + ")";
}

void GlslEmitter::emit_vertex(const Stmt& stmt) {
  for (size_t i = 0; i < entry_.outputs.size(); ++i) {
    const std::string name = "g_result_" + std::to_string(i);
    if (made_.insert(name).second) {
      declarations_ += vector_type(entry_.outputs[i]) + " " + name + ";\n";
    }
    line(name + " = " + value(stmt.operands[i]) + ";");
    graphics_output(i, name);
  }
  if (writes_point_size(entry_)) line("gl_PointSize = 1.0;");
  line("EmitVertex();");
}

// The samples of the targets. [spirv_interface.h: kSampleCountConstant]
std::string GlslEmitter::sample_count() {
  constant(shader::spirv::kSampleCountConstant, "g_sample_count");
  return "max(g_sample_count, 1u)";
}

// Converts a target as D3D does where the driver does not. [spirv_interface.h: kTargetConstant]
std::string GlslEmitter::converted_target(const SignatureElement& element,
                                          const std::string& name) {
  const uint32_t slot = element.semantic_index;
  const std::string bits = "g_target_" + std::to_string(slot);
  constant(shader::spirv::kTargetConstant + slot, bits);
  const std::string type = vector_type(element);
  std::string out = type + "(";
  for (int i = 0; i < element.components; ++i) {
    out += (i == 0 ? "k_target(" : ", k_target(") + component_of(element, name, i) + ", " + bits +
           " >> " + std::to_string(8 * i) + " & 255u)";
  }
  return out + ")";
}

// Declares the variables that an output goes to and writes `name`, of the element's type, to them.
void GlslEmitter::graphics_output(size_t index, const std::string& name) {
  const SignatureElement& element = entry_.outputs[index];
  const std::string type = vector_type(element);
  const auto at_location = [&](uint32_t location) {
    const std::string out = "g_out_" + std::to_string(index);
    const bool flat = entry_.stage != kStagePixel &&
                      element.interpolation == shader::Interpolation::kNoInterpolation;
    if (made_.insert(out).second) {
      declarations_ += "layout(location = " + std::to_string(location) + ") " +
                       (flat ? "flat " : "") + "out " + type + " " + out + ";\n";
    }
    line(out + " = " + name + ";");
  };
  switch (element.system_value) {
    case shader::SystemValue::kTarget: {
      // Components that the shader does not have are 0. [RAS-111]
      SignatureElement whole = element;
      whole.components = 4;
      const std::string type_of_all = vector_type(whole);
      std::string rest;
      for (int i = element.components; i < 4; ++i) rest += ", 0";
      const std::string out = "g_out_" + std::to_string(index);
      declarations_ += "layout(location = " + std::to_string(element.semantic_index) + ") out " +
                       type_of_all + " " + out + ";\n";
      return line(out + " = " + type_of_all + "(" + converted_target(element, name) + rest + ");");
    }
    case shader::SystemValue::kDepth:
      return line("gl_FragDepth = isnan(" + name +
                  ") ? uintBitsToFloat(k_dispatch.base[0]) : " + name + ";");
    case shader::SystemValue::kCoverage:
      // Drivers with one sample may not look at the mask.
      line("if ((uint(" + name + ") & ((1u << " + sample_count() + ") - 1u)) == 0u) demote;");
      return line("gl_SampleMask[0] = int(" + name + ");");
    case shader::SystemValue::kPosition:
      return line("gl_Position = " + name + ";");
    case shader::SystemValue::kPrimitiveId:
      line("gl_PrimitiveID = int(" + name + ");");
      break;
    case shader::SystemValue::kRenderTargetArrayIndex:
      line("gl_Layer = uint(" + name + ") < k_dispatch.dimensions[0] ? int(" + name + ") : 0;");
      break;
    case shader::SystemValue::kViewportArrayIndex:
      line("gl_ViewportIndex = uint(" + name + ") < 16u ? int(" + name + ") : 0;");
      break;
    case shader::SystemValue::kClipDistance:
    case shader::SystemValue::kCullDistance: {
      const bool clips = element.system_value == shader::SystemValue::kClipDistance;
      int first = 0;
      for (size_t i = 0; i < index; ++i) {
        const SignatureElement& other = entry_.outputs[i];
        if (other.system_value == element.system_value) first += other.components;
      }
      for (int i = 0; i < element.components; ++i) {
        line(std::string(clips ? "gl_ClipDistance[" : "gl_CullDistance[") +
             std::to_string(first + i) + "] = " + component_of(element, name, i) + ";");
      }
      break;
    }
    default:
      break;
  }
  at_location(static_cast<uint32_t>(index));
}

void GlslEmitter::graphics_main() {
  const auto& parameters = entry_.function->parameters;
  std::string call = function_names_[entry_.function] + "(";
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (i > 0) call += ", ";
    switch (entry_.parameters[i]) {
      case EntryParameter::kInput:
        call += graphics_input(i);
        break;
      case EntryParameter::kIsLive:
        call += "!gl_HelperInvocation";
        break;
      default:
        line(type(parameters[i]->type) + " g_result_" + std::to_string(i) + ";");
        call += "g_result_" + std::to_string(i);
        break;
    }
  }
  line(call + ");");
  if (entry_.stage == kStageGeometry) return;
  for (size_t i = 0; i < entry_.outputs.size(); ++i) {
    graphics_output(i, "g_result_" + std::to_string(entry_.inputs.size() + i));
  }
  if (writes_point_size(entry_)) line("gl_PointSize = 1.0;");
}

std::string GlslEmitter::graphics_head() const {
  std::string out;
  for (const SignatureElement& element : entry_.outputs) {
    const bool layered = element.system_value == shader::SystemValue::kRenderTargetArrayIndex ||
                         element.system_value == shader::SystemValue::kViewportArrayIndex;
    if (!layered || entry_.stage == kStageGeometry) continue;
    out += "#extension GL_ARB_shader_viewport_layer_array : require\n";
    break;
  }
  const bool masks = std::any_of(
      entry_.outputs.begin(), entry_.outputs.end(),
      [](const SignatureElement& e) { return e.system_value == shader::SystemValue::kCoverage; });
  if (masks || (entry_.graphics_flags & shader::kGraphicsDiscards) != 0) {
    out += "#extension GL_EXT_demote_to_helper_invocation : require\n";
  }
  return out;
}

std::string GlslEmitter::graphics_layout() const {
  std::string out;
  if (entry_.stage == kStagePixel) {
    const bool early = entry_.graphics_flags & shader::kGraphicsEarlyDepthStencil;
    return early ? "layout(early_fragment_tests) in;\n" : "";
  }
  if (entry_.stage == kStageGeometry) {
    const shader::GeometryShape& shape = entry_.geometry;
    constexpr const char* kInputs[] = {"points", "lines", "triangles"};
    constexpr const char* kOutputs[] = {"points", "line_strip", "triangle_strip"};
    out += std::string("layout(") + kInputs[shape.corners - 1] +
           ", invocations = " + std::to_string(shape.instances) + ") in;\nlayout(" +
           kOutputs[shape.output_corners - 1] +
           ", max_vertices = " + std::to_string(shape.most_vertices) + ") out;\n";
  }
  int sizes[2] = {0, 0};  // clip and cull distances
  bool has_position = false;
  for (const SignatureElement& element : entry_.outputs) {
    has_position = has_position || element.system_value == shader::SystemValue::kPosition;
    if (element.system_value == shader::SystemValue::kClipDistance) sizes[0] += element.components;
    if (element.system_value == shader::SystemValue::kCullDistance) sizes[1] += element.components;
  }
  // Without the members that are not written, which count where outputs are limited.
  out += "out gl_PerVertex {\n  vec4 gl_Position;\n";
  if (writes_point_size(entry_)) out += "  float gl_PointSize;\n";
  if (sizes[0] != 0) out += "  float gl_ClipDistance[" + std::to_string(sizes[0]) + "];\n";
  if (sizes[1] != 0) out += "  float gl_CullDistance[" + std::to_string(sizes[1]) + "];\n";
  out += "};\n";
  if (has_position) out += "invariant gl_Position;\n";
  return out;
}

// SPIR-V takes derivatives of 32-bit floats only, and of pixel shaders.
std::string GlslEmitter::derivative(const Stmt& stmt) {
  constexpr const char* kNames[] = {"dFdxCoarse", "dFdyCoarse", "dFdxFine", "dFdyFine"};
  const Type* t = stmt.operands[0]->type;
  const auto op = static_cast<size_t>(stmt.wave) - static_cast<size_t>(shader::WaveOp::kDdxCoarse);
  const std::string real = glsl::vector_name(
      Scalar::kFloat32, t->kind == TypeKind::kScalar ? 1 : static_cast<int>(t->columns));
  const std::string name =
      entry_.stage == kStagePixel ? kNames[op] : difference_function(stmt.wave, real);
  return type(t) + "(" + name + "(" + real + "(" + value(stmt.operands[0]) + ")))";
}

}  // namespace kaamos::hlsl
