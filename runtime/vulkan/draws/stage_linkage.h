// SPDX-License-Identifier: MIT
//
// This file holds what the SPIR-V of later stages needs to know of the rest of its pipeline.
// [spirv_interface.h: Vertex and pixel shaders]
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/vulkan/draws/graphics_pipeline.h"
#include "runtime/vulkan/spirv/shader_stage.h"

namespace kaamos::vulkan {

// The location of SV_Barycentrics: that of the vertex shader's SV_Position, which is built in.
uint32_t barycentrics_location(const runtime::LinkedGraphics& linked);

// The inputs of the pixel shader that are values of the second or third vertex, which the geometry
// shader writes to locations behind the vertex shader's outputs.
struct VertexAttribute {
  uint32_t input = 0;     // of the pixel shader
  uint32_t output = 0;    // of the vertex shader
  uint32_t vertex = 0;    // 1 or 2
  uint32_t location = 0;  // kLocationCount and more: there is none
};
inline constexpr uint32_t kLocationCount = 32;
std::vector<VertexAttribute> vertex_attributes(const runtime::LinkedGraphics& linked);

// The code of the geometry shader, or of the pixel shader, with the locations of the outputs of the
// shader before it.
std::vector<uint32_t> linked_geometry_code(const runtime::LinkedGraphics& linked);
std::vector<uint32_t> linked_pixel_code(const runtime::LinkedGraphics& linked);

// kTargetConstant of each target, and kSampleCountConstant.
std::vector<StageConstant> target_constants(const Gpu& gpu, const runtime::LinkedGraphics& linked,
                                            const GraphicsVariant& wanted);

}  // namespace kaamos::vulkan
