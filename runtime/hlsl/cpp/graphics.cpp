// SPDX-License-Identifier: MIT
//
// Entry points of vertex, geometry and pixel shaders: what stands between the columns of graphics.h
// and the parameters of the IR's function.
#include "runtime/hlsl/cpp/wide_emitter.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

const char* system_value_name(shader::SystemValue value) {
  constexpr const char* kNames[] = {"kNone",
                                    "kPosition",
                                    "kVertexId",
                                    "kInstanceId",
                                    "kPrimitiveId",
                                    "kIsFrontFace",
                                    "kBarycentrics",
                                    "kClipDistance",
                                    "kCullDistance",
                                    "kRenderTargetArrayIndex",
                                    "kViewportArrayIndex",
                                    "kTarget",
                                    "kDepth",
                                    "kCoverage",
                                    "kStartVertexLocation",
                                    "kStartInstanceLocation",
                                    "kSampleIndex",
                                    "kSampleCount",
                                    "kGeometryInstance"};
  return kNames[static_cast<size_t>(value)];
}

const char* column_type_name(shader::ColumnType type) {
  constexpr const char* kNames[] = {"kFloat", "kInt", "kUint"};
  return kNames[static_cast<size_t>(type)];
}

const char* interpolation_name(shader::Interpolation interpolation) {
  constexpr const char* kNames[] = {
      "kLinear",     "kNoPerspective",       "kCentroid",        "kCentroidNoPerspective",
      "kSample",     "kSampleNoPerspective", "kNoInterpolation", "kSecondVertex",
      "kThirdVertex"};
  return kNames[static_cast<size_t>(interpolation)];
}

uint32_t column_count(const std::vector<SignatureElement>& elements) {
  return elements.empty() ? 0 : elements.back().first_column + elements.back().components;
}

bool is_vertex(const EntryPoint& entry) {
  return entry.stage == kStageVertex;
}

std::string columns_of(const EntryPoint& entry, size_t parameter) {
  const size_t inputs = entry.inputs.size();
  const bool is_input = parameter < inputs;
  const SignatureElement& element =
      is_input ? entry.inputs[parameter] : entry.outputs[parameter - inputs];
  return std::string(is_input ? "lanes.inputs + " : "lanes.outputs + ") +
         std::to_string(element.first_column) + "u";
}

}  // namespace

void CppEmitter::emit_signature_elements(const std::string& name,
                                         const std::vector<SignatureElement>& elements) {
  open("static const ks::SignatureElement " + name + "[] = {");
  for (const SignatureElement& e : elements) {
    const bool placed = e.location.line != 0 && e.location.file < module_.files.size();
    line("{" + quote(e.semantic) + ", " + std::to_string(e.semantic_index) +
         "u, ks::SystemValue::" + system_value_name(e.system_value) + ", ks::ColumnType::" +
         column_type_name(e.type) + ", ks::Interpolation::" + interpolation_name(e.interpolation) +
         ", " + std::to_string(e.components) + ", " + std::to_string(e.first_column) + "u, " +
         (placed ? quote(module_.files[e.location.file]) : "nullptr") + ", " +
         std::to_string(e.location.line) + "u},");
  }
  line("{}};");
  --indent_;
}

// `functions` are the last members of the GraphicsDesc.
void CppEmitter::emit_graphics_desc(size_t index, const std::string& functions) {
  const EntryPoint& entry = module_.entry_points[index];
  const std::string number = std::to_string(index);
  at_generated();
  emit_signature_elements("inputs_" + number, entry.inputs);
  emit_signature_elements("outputs_" + number, entry.outputs);
  line("static const ks::GraphicsDesc graphics_" + number + " = {inputs_" + number + ", " +
       std::to_string(entry.inputs.size()) + "u, " + std::to_string(column_count(entry.inputs)) +
       "u, outputs_" + number + ", " + std::to_string(entry.outputs.size()) + "u, " +
       std::to_string(column_count(entry.outputs)) + "u, " + std::to_string(entry.graphics_flags) +
       "u, " + functions + "};");
}

// What is not a corner's own is in the first row.
void CppEmitter::emit_geometry_entry(size_t index) {
  const EntryPoint& entry = module_.entry_points[index];
  const std::string number = std::to_string(index);
  open("static void geometry_" + number +
       "(ks::Invocation& invocation, [[maybe_unused]] const ks::GeometryInputs& inputs, "
       "ks::GeometryStream& stream) {");
  line("u::Context ctx(invocation);");
  line("ctx.stream = &stream;");
  emit_static_initialisers(*entry.function);
  std::string call = "u::" + function_names_[entry.function] + "(ctx";
  for (size_t i = 0; i < entry.inputs.size(); ++i) {
    const Type* t = entry.function->parameters[i]->type;
    const std::string column = std::to_string(entry.inputs[i].first_column) + "u";
    call += t->kind == TypeKind::kArray
                ? ", ks::corner_values<" + type(t->element) + ", " + std::to_string(t->count) +
                      ">(inputs, " + column + ")"
                : ", ks::corner_value<" + type(t) + ">(inputs, 0, " + column + ")";
  }
  line(call + ");");
  close("}");
  const shader::GeometryShape& shape = entry.geometry;
  emit_graphics_desc(index, "nullptr, nullptr, nullptr, geometry_" + number + ", {" +
                                std::to_string(shape.corners) + "u, " +
                                std::to_string(shape.output_corners) + "u, " +
                                std::to_string(shape.most_vertices) + "u, " +
                                std::to_string(shape.instances) + "u}");
}

// One lane: reads its columns, calls the function, writes them back.
void CppEmitter::emit_graphics_lane(const EntryPoint& entry) {
  emit_static_initialisers(*entry.function);
  const auto& parameters = entry.function->parameters;
  std::string call = "u::" + function_names_[entry.function] + "(ctx";
  std::string after;
  for (size_t i = 0; i < parameters.size(); ++i) {
    const std::string t = type(parameters[i]->type);
    const std::string out = "out_" + std::to_string(i);
    switch (entry.parameters[i]) {
      case EntryParameter::kInput:
        call += ", ks::column_value<" + t + ">(" + columns_of(entry, i) + ", lane)";
        continue;
      case EntryParameter::kIsLive:
        call += ", (lanes.live >> lane & 1u) != 0";
        continue;
      case EntryParameter::kOutput:
        after += "ks::put_columns(" + columns_of(entry, i) + ", lane, " + out + "); ";
        break;
      default:
        after += "if (!" + out + ") lanes.live &= ~(1u << lane);";
        break;
    }
    line(t + " " + out + ";");
    call += ", " + out;
  }
  line(call + ");");
  if (!after.empty()) line(after);
}

void CppEmitter::emit_graphics_entry(size_t index) {
  const EntryPoint& entry = module_.entry_points[index];
  const std::string number = std::to_string(index);
  at_generated();
  if (entry.stage == kStageGeometry) return emit_geometry_entry(index);
  if (entry.function->has_waves) {
    open("static void pixel_" + number +
         "(ks::Invocation& invocation, ks::PixelLanes& lanes, ks::ComputeGroup& group, uint32_t "
         "lane) {");
    line("u::Context ctx(invocation);");
    line("ctx.group = &group;");
    emit_graphics_lane(entry);
    close("}");
    return emit_graphics_desc(index, "nullptr, nullptr, pixel_" + number);
  }
  // Without derivatives helpers have nothing to do.
  const std::string name = (is_vertex(entry) ? "vertex_" : "pixel_") + number;
  open("static void " + name + "(ks::Invocation& invocation, " +
       (is_vertex(entry) ? "const ks::VertexLanes& lanes) {" : "ks::PixelLanes& lanes) {"));
  open(std::string("for (uint32_t rest = lanes.") + (is_vertex(entry) ? "active" : "live") +
       "; rest != 0; rest &= rest - 1) {");
  line("const uint32_t lane = static_cast<uint32_t>(__builtin_ctz(rest));");
  line("u::Context ctx(invocation);");
  emit_graphics_lane(entry);
  close("}");
  close("}");
  emit_graphics_desc(
      index, is_vertex(entry) ? name + ", nullptr, nullptr" : "nullptr, " + name + ", nullptr");
}

bool WideEmitter::emit_graphics(size_t index) {
  const EntryPoint& entry = out_.module_.entry_points[index];
  const WideFunction* function = entries_[index];
  if (function == nullptr || !entry.is_graphics()) return false;
  const bool waves = entry.function->has_waves;
  const std::string name = (is_vertex(entry) ? "vertex_" : "pixel_") + std::to_string(index);
  current_ = function;
  out_.at_generated();
  open("static void " + name + "(ks::Invocation& invocation, " +
       (is_vertex(entry) ? "const ks::VertexLanes& lanes) {" : "ks::PixelLanes& lanes) {"));
  line("u::WideContext ctx(invocation);");
  if (waves) {
    line("ks::ComputeGroup group;");
    line("group.wave_lanes = 4;");
    line("ctx.group = &group;");
  }
  mask_ = "active";
  line(std::string("const ks::lanes active = ks::lanes_of_bits(lanes.") +
       (is_vertex(entry) || waves ? "active" : "live") + ");");
  line("if (!ks::any_lane(active)) return;");
  emit_static_initialisers(*entry.function);
  std::string call = "u::" + names_[function] + "(ctx, active";
  std::string after;
  const auto& parameters = entry.function->parameters;
  for (size_t i = 0; i < parameters.size(); ++i) {
    const bool varies = function->is_varying(parameters[i]);
    const std::string t = varies ? type(parameters[i]->type) : out_.type(parameters[i]->type);
    const std::string out = "out_" + std::to_string(i);
    switch (entry.parameters[i]) {
      case EntryParameter::kInput:
        call += varies ? ", ks::wide_column_value<" + t + ">(" + columns_of(entry, i) + ")"
                       : ", ks::column_value<" + t + ">(" + columns_of(entry, i) + ", first)";
        continue;
      case EntryParameter::kIsLive:
        call += ", ks::lanes_of_bits(lanes.live)";
        continue;
      case EntryParameter::kOutput:
        after += varies ? "ks::put_wide_columns(" + columns_of(entry, i) + ", " + out + "); "
                        : "ks::put_wide_columns(" + columns_of(entry, i) + ", ks::spread<" +
                              type(parameters[i]->type) + ">(" + out + ")); ";
        break;
      default:
        after += varies ? "lanes.live &= ks::bits_of(" + out + ");"
                        : "if (!" + out + ") lanes.live = 0;";
        break;
    }
    line(t + " " + out + "{};");
    call += ", " + out;
  }
  if (entry.stage == kStagePixel) {
    line(
        "[[maybe_unused]] const uint32_t first = "
        "static_cast<uint32_t>(__builtin_ctz(lanes.active));");
  }
  line(call + ");");
  if (!after.empty()) line(after);
  close("}");
  current_ = nullptr;
  out_.emit_graphics_desc(
      index, is_vertex(entry) ? name + ", nullptr, nullptr" : "nullptr, " + name + ", nullptr");
  return true;
}

}  // namespace kaamos::hlsl
