// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/stage_linkage.h"

#include <algorithm>

#include "kaamos/shader/spirv_interface.h"
#include "kaamos/shader/spirv_locations.h"

namespace kaamos::vulkan {
namespace {

using runtime::LinkedGraphics;

uint32_t output_at(const shader::GraphicsDesc& code, uint32_t column) {
  for (uint32_t i = 0; i < code.output_count; ++i) {
    if (code.outputs[i].first_column == column) return i;
  }
  return kLocationCount - 1;
}

// A location that nothing writes.
uint32_t free_location(const LinkedGraphics& linked) {
  return std::min(linked.vertices_desc().output_count, kLocationCount - 1);
}

// A byte for each component, the lowest for red. [kTargetConstant]
uint32_t bits_of_components(uint32_t color, uint32_t alpha) {
  return color | color << 8 | color << 16 | alpha << 24;
}

uint32_t conversion_of(const Gpu& gpu, rtapi::Format format, bool blends) {
  const rtapi::FormatInfo info = rtapi::GetFormatInfo(format);
  const bool integer =
      info.type == rtapi::FormatClass::kUint || info.type == rtapi::FormatClass::kSint;
  const bool ten_bits =
      format == rtapi::Format::kR10G10B10A2Uint || format == rtapi::Format::kR10G10B10A2Unorm;
  if (ten_bits) {
    const bool truncates = gpu.workarounds().has(Workaround::kRoundTenBits);
    return integer || (truncates && !blends) ? bits_of_components(10, 2) : 0;
  }
  if (info.type == rtapi::FormatClass::kSnorm) {
    return gpu.workarounds().has(Workaround::kLimitSnorm)
               ? bits_of_components(shader::spirv::kLimitedSnorm, shader::spirv::kLimitedSnorm)
               : 0;
  }
  return integer && info.channel_bits < 32
             ? bits_of_components(info.channel_bits, info.channel_bits)
             : 0;
}

}  // namespace

std::vector<VertexAttribute> vertex_attributes(const LinkedGraphics& linked) {
  std::vector<VertexAttribute> out;
  if (!linked.has_pixel()) return out;
  const shader::GraphicsDesc& pixel = linked.pixel_desc();
  for (uint32_t i = 0; i < pixel.input_count; ++i) {
    const shader::Interpolation interpolation = pixel.inputs[i].interpolation;
    if (interpolation <= shader::Interpolation::kNoInterpolation) continue;
    for (const runtime::LinkedVarying& varying : linked.varyings) {
      if (varying.pixel_column != pixel.inputs[i].first_column) continue;
      // Behind free_location(), which nothing writes.
      const auto location =
          static_cast<uint32_t>(linked.vertex_desc().output_count + 1 + out.size());
      out.push_back({i, output_at(linked.vertex_desc(), varying.vertex_column),
                     interpolation == shader::Interpolation::kSecondVertex ? 1u : 2u, location});
    }
  }
  return out;
}

uint32_t barycentrics_location(const LinkedGraphics& linked) {
  return output_at(linked.vertex_desc(), linked.vertex_columns.position);
}

std::vector<uint32_t> linked_geometry_code(const LinkedGraphics& linked) {
  const shader::ExportDesc& code = *linked.geometry.code;
  std::vector<uint32_t> words(code.spirv, code.spirv + code.spirv_words);
  const shader::GraphicsDesc& geometry = linked.geometry_desc();
  std::vector<uint32_t> locations;
  for (uint32_t i = 0; i < geometry.input_count; ++i) {
    if (geometry.inputs[i].system_value == shader::SystemValue::kPosition) {
      locations.push_back(shader::spirv::kPositionLocation);
      continue;
    }
    const auto corner = std::find_if(
        linked.corners.begin(), linked.corners.end(), [&](const runtime::LinkedCorner& part) {
          return part.geometry_column == geometry.inputs[i].first_column;
        });
    locations.push_back(corner == linked.corners.end()
                            ? kLocationCount - 1
                            : output_at(linked.vertex_desc(), corner->vertex_column));
  }
  shader::spirv::relocate_inputs(words, locations);
  return words;
}

std::vector<uint32_t> linked_pixel_code(const LinkedGraphics& linked) {
  const shader::ExportDesc& code = *linked.pixel.code;
  std::vector<uint32_t> words(code.spirv, code.spirv + code.spirv_words);
  const shader::GraphicsDesc& pixel = linked.pixel_desc();
  const std::vector<VertexAttribute> of_vertices = vertex_attributes(linked);
  std::vector<uint32_t> locations;
  for (uint32_t i = 0; i < pixel.input_count; ++i) {
    const shader::SignatureElement& input = pixel.inputs[i];
    if (input.system_value == shader::SystemValue::kBarycentrics) {
      locations.push_back(barycentrics_location(linked));
      continue;
    }
    const auto of_vertex =
        std::find_if(of_vertices.begin(), of_vertices.end(),
                     [i](const VertexAttribute& attribute) { return attribute.input == i; });
    if (of_vertex != of_vertices.end()) {
      locations.push_back(of_vertex->location);
      continue;
    }
    const auto varying = std::find_if(
        linked.varyings.begin(), linked.varyings.end(),
        [&](const runtime::LinkedVarying& v) { return v.pixel_column == input.first_column; });
    locations.push_back(varying == linked.varyings.end()
                            ? free_location(linked)
                            : output_at(linked.vertices_desc(), varying->vertex_column));
  }
  shader::spirv::relocate_inputs(words, locations);
  if (linked.blends_two_sources) shader::spirv::make_second_source(words);
  return words;
}

std::vector<StageConstant> target_constants(const Gpu& gpu, const LinkedGraphics& linked,
                                            const GraphicsVariant& wanted) {
  std::vector<StageConstant> constants;
  if (linked.samples > 1) {
    constants.push_back({shader::spirv::kSampleCountConstant, linked.samples});
  }
  // The second source is converted as the first one.
  const uint32_t outputs = linked.blends_two_sources ? 2 : wanted.color_count;
  for (uint32_t i = 0; i < outputs; ++i) {
    const uint32_t target = linked.blends_two_sources ? 0 : i;
    const uint32_t conversion =
        conversion_of(gpu, wanted.colors[target], linked.blend[target].BlendEnable);
    if (conversion != 0) constants.push_back({shader::spirv::kTargetConstant + i, conversion});
  }
  return constants;
}

}  // namespace kaamos::vulkan
