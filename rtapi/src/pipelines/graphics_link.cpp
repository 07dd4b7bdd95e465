// SPDX-License-Identifier: MIT
#include "rtapi/src/pipelines/graphics_link.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/pipelines/hit_attributes.h"

namespace rtapi::detail {

namespace {

using runtime::LinkedGraphics;
using shader::ColumnType;
using shader::SignatureElement;
using shader::SystemValue;

constexpr uint32_t kMaxElementEnd = 2048;  // bytes from the start of a vertex
constexpr uint32_t kMaxInterstageVectors = 32;
constexpr uint32_t kMaxClipAndCullDistances = 8;

std::span<const SignatureElement> inputs_of(const runtime::LinkedShader& s) {
  return {s.code->graphics->inputs, s.code->graphics->input_count};
}
std::span<const SignatureElement> outputs_of(const runtime::LinkedShader& s) {
  return {s.code->graphics->outputs, s.code->graphics->output_count};
}

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::toupper(x) == std::toupper(y);
  });
}

bool same_semantic(const SignatureElement& a, const SignatureElement& b) {
  return a.semantic_index == b.semantic_index && same_name(a.semantic, b.semantic);
}

const char* type_name(ColumnType type) {
  switch (type) {
    case ColumnType::kFloat:
      return "float";
    case ColumnType::kInt:
      return "int";
    default:
      return "uint";
  }
}

// "COLOR1 (float3, gbuffer.hlsl:31)"
std::string describe(const SignatureElement& e) {
  std::string type = type_name(e.type);
  if (e.components > 1) type += std::to_string(e.components);
  return concat(e.semantic, e.semantic_index, " (", type, ", ", e.file ? e.file : "", ":", e.line,
                ")");
}

std::string list_semantics(std::span<const InputElementDesc> elements) {
  std::string out;
  for (const InputElementDesc& e : elements) {
    out += concat(out.empty() ? "" : ", ", e.SemanticName, e.SemanticIndex);
  }
  return out.empty() ? "nothing" : out;
}

// The type class that a shader must declare for a format. [RAS-18]
ColumnType column_type_of(Format format) {
  switch (GetFormatInfo(format).type) {
    case FormatClass::kUint:
      return ColumnType::kUint;
    case FormatClass::kSint:
      return ColumnType::kInt;
    default:
      return ColumnType::kFloat;
  }
}

Status check_element(const InputElementDesc& e, size_t index, uint32_t offset) {
  const std::string where =
      concat("InputLayout[", index, "] (", e.SemanticName, e.SemanticIndex, ")");
  const FormatInfo info = GetFormatInfo(e.Format);
  if (info.type == FormatClass::kUnsupported || info.type == FormatClass::kTypeless || info.srgb ||
      IsDepthFormat(e.Format)) {
    return make_error(Id::kInputLayout, where, " has DXGI format ", static_cast<uint32_t>(e.Format),
                      ", which vertices cannot have");
  }
  if (e.InputSlot >= kIAVertexInputResourceSlotCount) {
    return make_error(Id::kInputLayout, where, " is in slot ", e.InputSlot, "; there are 0 to 31");
  }
  const uint32_t alignment = std::min<uint32_t>(4, info.bytes);
  if (offset % alignment != 0 || offset + info.bytes > kMaxElementEnd) {
    return make_error(Id::kInputLayout, where, " is at byte ", offset,
                      "; it must be a multiple of ", alignment, " and end by byte 2048");
  }
  if (e.InputSlotClass > InputClassification::kPerInstanceData) {
    return make_error(Id::kInputLayout, where, " has class ",
                      static_cast<uint32_t>(e.InputSlotClass), "; it must be 0 or 1");
  }
  if (e.InputSlotClass == InputClassification::kPerVertexData && e.InstanceDataStepRate != 0) {
    return make_error(Id::kInputLayout, where, " changes with the vertex, but has a step rate of ",
                      e.InstanceDataStepRate, "; it must be 0");
  }
  return {};
}

// Offsets of all elements, appended ones resolved in the order of the array, slot by slot. [RAS-16]
Result<std::vector<uint32_t>> offsets_of(std::span<const InputElementDesc> elements) {
  std::array<uint32_t, kIAVertexInputResourceSlotCount> ends = {};
  std::vector<uint32_t> out;
  for (size_t i = 0; i < elements.size(); ++i) {
    const InputElementDesc& e = elements[i];
    const uint32_t bytes = GetFormatInfo(e.Format).bytes;
    uint32_t offset = e.AlignedByteOffset;
    if (offset == kAppendAlignedElement && e.InputSlot < ends.size()) {
      offset =
          static_cast<uint32_t>(align_up(ends[e.InputSlot], std::clamp<uint32_t>(bytes, 1, 4)));
    }
    if (offset > kMaxElementEnd) offset = kMaxElementEnd + 1;
    if (Status s = check_element(e, i, offset); !s.ok()) return s.error();
    ends[e.InputSlot] = offset + bytes;
    out.push_back(offset);
    for (size_t k = 0; k < i; ++k) {
      const InputElementDesc& other = elements[k];
      if (other.SemanticIndex == e.SemanticIndex && same_name(other.SemanticName, e.SemanticName)) {
        return make_error(Id::kInputLayout, "InputLayout has ", e.SemanticName, e.SemanticIndex,
                          " twice, as elements ", k, " and ", i);
      }
      if (other.InputSlot == e.InputSlot && other.InputSlotClass != e.InputSlotClass) {
        return make_error(Id::kInputLayout, "InputLayout elements ", k, " and ", i, " are in slot ",
                          e.InputSlot, ", one with the vertex and one with the instance");
      }
    }
  }
  return out;
}

Status link_vertex_input(const GraphicsPipelineStateDesc& desc, std::span<const uint32_t> offsets,
                         const SignatureElement& input, LinkedGraphics& linked) {
  switch (input.system_value) {
    case SystemValue::kVertexId:
      linked.vertex_columns.vertex_id = input.first_column;
      return {};
    case SystemValue::kInstanceId:
      linked.vertex_columns.instance_id = input.first_column;
      return {};
    case SystemValue::kStartVertexLocation:
      linked.vertex_columns.start_vertex = input.first_column;
      return {};
    case SystemValue::kStartInstanceLocation:
      linked.vertex_columns.start_instance = input.first_column;
      return {};
    default:
      break;
  }
  const auto& elements = desc.InputLayout;
  const auto it = std::find_if(elements.begin(), elements.end(), [&](const InputElementDesc& e) {
    return e.SemanticIndex == input.semantic_index && same_name(e.SemanticName, input.semantic);
  });
  if (it == elements.end()) {
    return make_error(Id::kInputLayout, "vertex shader ", in_quotes(linked.vertex.name), " reads ",
                      describe(input), "; the input layout has ", list_semantics(elements));
  }
  if (column_type_of(it->Format) != input.type) {
    return make_error(Id::kInputLayout, "vertex shader ", in_quotes(linked.vertex.name), " reads ",
                      describe(input), ", but DXGI format ", static_cast<uint32_t>(it->Format),
                      " of the element gives ", type_name(column_type_of(it->Format)));
  }
  runtime::LinkedElement element;
  element.slot = it->InputSlot;
  element.offset_bytes = offsets[static_cast<size_t>(it - elements.begin())];
  element.format = it->Format;
  element.per_instance = it->InputSlotClass == InputClassification::kPerInstanceData;
  element.step_rate = it->InstanceDataStepRate;
  element.first_column = input.first_column;
  element.components = input.components;
  linked.elements.push_back(element);
  return {};
}

void append_columns(const SignatureElement& e, std::vector<uint32_t>& columns) {
  for (uint32_t c = 0; c < e.components; ++c) columns.push_back(e.first_column + c);
}

// "vertex shader "main""
std::string name_of(const runtime::LinkedShader& s) {
  return concat(stage_name(s.stage), " shader ", in_quotes(s.name));
}

// What the rasterizer reads of the last shader before it.
Status link_vertices(LinkedGraphics& linked) {
  auto& columns = linked.vertex_columns;
  const std::string writes = concat(name_of(linked.vertices()), " writes ");
  for (const SignatureElement& e : outputs_of(linked.vertices())) {
    switch (e.system_value) {
      case SystemValue::kPrimitiveId:
        columns.primitive_id = e.first_column;
        break;
      case SystemValue::kPosition:
        columns.position = e.first_column;
        break;
      case SystemValue::kRenderTargetArrayIndex:
        columns.target_array_index = e.first_column;
        break;
      case SystemValue::kViewportArrayIndex:
        columns.viewport_array_index = e.first_column;
        break;
      case SystemValue::kClipDistance:
        append_columns(e, columns.clip_distances);
        break;
      case SystemValue::kCullDistance:
        append_columns(e, columns.cull_distances);
        break;
      default:
        break;
    }
  }
  if (columns.position == runtime::kNoColumn) {
    return make_error(Id::kStageLinkage, writes, "no SV_Position, which rasterization needs");
  }
  const size_t distances = columns.clip_distances.size() + columns.cull_distances.size();
  if (distances > kMaxClipAndCullDistances) {
    return make_error(Id::kStageLinkage, writes, columns.clip_distances.size(), " clip and ",
                      columns.cull_distances.size(), " cull distances; together at most 8");
  }
  const uint32_t vectors = linked.vertices_desc().output_count;
  if (vectors > kMaxInterstageVectors) {
    return make_error(Id::kStageLinkage, writes, vectors, " vectors; at most 32");
  }
  return {};
}

// The output of `from` with the semantic of an input of `to`; null: there is none.
Result<const SignatureElement*> find_output(const runtime::LinkedShader& from,
                                            const runtime::LinkedShader& to,
                                            const SignatureElement& input) {
  for (const SignatureElement& output : outputs_of(from)) {
    if (!same_semantic(output, input)) continue;
    if (output.type != input.type || output.components < input.components) {
      return make_error(Id::kStageLinkage, name_of(to), " reads ", describe(input), "; ",
                        name_of(from), " writes ", describe(output));
    }
    return &output;
  }
  return nullptr;
}

Status not_written(const runtime::LinkedShader& from, const runtime::LinkedShader& to,
                   const SignatureElement& input) {
  return make_error(Id::kStageLinkage, name_of(to), " reads ", describe(input), ", which ",
                    name_of(from), " does not write");
}

// Vertices on their way into a geometry shader. [D3D11.3: 13]
Status link_geometry(LinkedGraphics& linked) {
  const shader::GeometryShape& shape = linked.geometry_desc().shape;
  if (shape.corners != static_cast<uint32_t>(linked.topology)) {
    constexpr const char* kNames[] = {"", "a point", "a line", "a triangle"};
    return make_error(Id::kStageLinkage, name_of(linked.geometry), " takes ", kNames[shape.corners],
                      ", but PrimitiveTopologyType is ", static_cast<uint32_t>(linked.topology),
                      ", of ", kNames[static_cast<uint32_t>(linked.topology)]);
  }
  for (const SignatureElement& input : inputs_of(linked.geometry)) {
    if (input.system_value == SystemValue::kPrimitiveId) {
      linked.geometry_columns.primitive_id = input.first_column;
    } else if (input.system_value == SystemValue::kGeometryInstance) {
      linked.geometry_columns.instance = input.first_column;
    } else {
      const auto output = find_output(linked.vertex, linked.geometry, input);
      if (!output.ok()) return output.error();
      if (*output == nullptr) return not_written(linked.vertex, linked.geometry, input);
      linked.corners.push_back({(*output)->first_column, input.first_column, input.components});
    }
  }
  return {};
}

// Returns whether the pipeline itself feeds the input.
bool link_pixel_system_value(const SignatureElement& input, runtime::PixelSystemColumns& columns) {
  switch (input.system_value) {
    case SystemValue::kPosition:
      columns.position = input.first_column;
      columns.position_components = input.components;
      columns.position_place = input.interpolation;
      return true;
    case SystemValue::kPrimitiveId:
      columns.primitive_id = input.first_column;
      return true;
    case SystemValue::kIsFrontFace:
      columns.is_front_face = input.first_column;
      return true;
    case SystemValue::kBarycentrics:
      columns.barycentrics = input.first_column;
      columns.barycentric_components = input.components;
      columns.barycentrics_no_perspective = shader::is_no_perspective(input.interpolation);
      columns.barycentrics_place = input.interpolation;
      return true;
    case SystemValue::kCoverage:
      columns.coverage_in = input.first_column;
      return true;
    case SystemValue::kSampleIndex:
      columns.sample_index = input.first_column;
      return true;
    case SystemValue::kSampleCount:
      columns.sample_count = input.first_column;
      return true;
    default:
      return false;
  }
}

Status link_pixel_input(const SignatureElement& input, LinkedGraphics& linked) {
  // Behind a geometry shader the pipeline knows no number of a primitive.
  if (input.system_value == SystemValue::kPrimitiveId && linked.has_geometry() &&
      linked.vertex_columns.primitive_id == runtime::kNoColumn) {
    return not_written(linked.geometry, linked.pixel, input);
  }
  if (link_pixel_system_value(input, linked.pixel_columns)) return {};
  const auto output = find_output(linked.vertices(), linked.pixel, input);
  if (!output.ok()) return output.error();
  if (*output != nullptr) {
    linked.varyings.push_back(
        {(*output)->first_column, input.first_column, input.components, input.interpolation});
    return {};
  }
  // Without a vertex shader's output these two are 0. [D3D11.3: 15.8.1, 15.15]
  if (input.system_value == SystemValue::kRenderTargetArrayIndex ||
      input.system_value == SystemValue::kViewportArrayIndex) {
    return {};
  }
  return not_written(linked.vertices(), linked.pixel, input);
}

// Native D3D12 links by registers, which follow the order of declaration. [RAS-21]
void warn_of_order(const DeviceImpl& device, const LinkedGraphics& linked) {
  // What GetAttributeAtVertex reads stands behind the inputs that are declared.
  const auto declared_end =
      std::find_if(linked.varyings.begin(), linked.varyings.end(), [](const auto& varying) {
        return varying.interpolation > shader::Interpolation::kNoInterpolation;
      });
  const bool in_order = std::is_sorted(
      linked.varyings.begin(), declared_end,
      [](const auto& a, const auto& b) { return a.vertex_column < b.vertex_column; });
  if (in_order) return;
  device.report(
      MessageSeverity::kWarning,
      make_error(Id::kGraphicsWarning, named("graphics pipeline", linked.name), ": pixel shader ",
                 in_quotes(linked.pixel.name), " declares its inputs in another order than ",
                 name_of(linked.vertices()),
                 " its outputs; Direct3D 12 itself links them by position and refuses "
                 "that"));
}

}  // namespace

Status link_input_layout(const GraphicsPipelineStateDesc& desc, LinkedGraphics& linked) {
  if (desc.InputLayout.size() > kIAVertexInputResourceSlotCount) {
    return make_error(Id::kInputLayout, "InputLayout has ", desc.InputLayout.size(),
                      " elements; at most 32");
  }
  auto offsets = offsets_of(desc.InputLayout);
  if (!offsets.ok()) return offsets.error();
  for (const SignatureElement& input : inputs_of(linked.vertex)) {
    if (Status s = link_vertex_input(desc, *offsets, input, linked); !s.ok()) return s;
  }
  return {};
}

Status link_stages(const DeviceImpl& device, LinkedGraphics& linked) {
  if (linked.has_geometry()) {
    if (Status s = link_geometry(linked); !s.ok()) return s;
  }
  if (Status s = link_vertices(linked); !s.ok()) return s;
  if (!linked.has_pixel()) return {};
  for (const SignatureElement& input : inputs_of(linked.pixel)) {
    if (Status s = link_pixel_input(input, linked); !s.ok()) return s;
  }
  warn_of_order(device, linked);
  return {};
}

namespace {

// What is joined with a target that the pixel shader writes: blending of floats and normalized
// formats, logic operations of UINT. [RAS-123, RAS-161]
Status check_joined(const DeviceImpl& device, const LinkedGraphics& linked, uint32_t slot) {
  const RenderTargetBlendDesc& blend = linked.blend[slot];
  const Format format = linked.target_formats[slot];
  const FormatClass type = GetFormatInfo(format).type;
  const char* fault = nullptr;
  if (blend.BlendEnable && (type == FormatClass::kUint || type == FormatClass::kSint)) {
    fault = ", whose integers cannot be blended";
  } else if (blend.BlendEnable && !device.backend->supports_target(format, true)) {
    fault = ", which this backend cannot blend";
  } else if (blend.LogicOpEnable && type != FormatClass::kUint) {
    fault = ", which has no logic operations; UINT formats have them";
  }
  if (fault == nullptr) return {};
  return make_error(Id::kTargetFormat, "RTVFormats[", slot, "] is DXGI format ",
                    static_cast<uint32_t>(format), fault);
}

}  // namespace

Status link_targets(const DeviceImpl& device, LinkedGraphics& linked) {
  if (!linked.has_pixel()) return {};
  for (const SignatureElement& e : outputs_of(linked.pixel)) {
    if (e.system_value == SystemValue::kDepth) linked.pixel_columns.depth = e.first_column;
    if (e.system_value == SystemValue::kCoverage) {
      linked.pixel_columns.coverage_out = e.first_column;
    }
    if (e.system_value != SystemValue::kTarget) continue;
    const uint32_t slot = e.semantic_index;
    if (slot >= kSimultaneousRenderTargetCount) continue;  // refused by the compiler
    linked.pixel_columns.targets[slot] = {e.first_column, e.components};
    const Format format = linked.target_formats[slot];
    if (slot >= linked.target_count || format == Format::kUnknown) {
      device.report(
          MessageSeverity::kWarning,
          make_error(Id::kGraphicsWarning, named("graphics pipeline", linked.name),
                     ": pixel shader ", in_quotes(linked.pixel.name), " writes ", describe(e),
                     ", but RTVFormats has no target in that slot: the output is dropped"));
      continue;
    }
    // The second source is in the place of another target's colour. [D3D11.3: 17.6]
    if (linked.blends_two_sources && slot != 0) {
      return make_error(Id::kGraphicsDesc,
                        "blending reads SV_Target1 as a second source, and pixel shader ",
                        in_quotes(linked.pixel.name), " writes ", describe(e), " to RTVFormats[",
                        slot, "], which is DXGI format ", static_cast<uint32_t>(format),
                        "; it may write no target but RTVFormats[0]");
    }
    if (Status s = check_joined(device, linked, slot); !s.ok()) return s;
    if (column_type_of(format) != e.type) {
      device.report(
          MessageSeverity::kWarning,
          make_error(Id::kTargetOutput, "pixel shader ", in_quotes(linked.pixel.name), " writes ",
                     describe(e), "; RTVFormats[", slot, "] is DXGI format ",
                     static_cast<uint32_t>(format), ", which takes ",
                     type_name(column_type_of(format)), ": the bits are taken as they are"));
    }
  }
  return {};
}

}  // namespace rtapi::detail
