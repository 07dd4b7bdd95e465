// SPDX-License-Identifier: MIT
//
// This file holds what a pixel shader's SPIR-V needs to know of the rest of its pipeline.
// [spirv_interface.h: Vertex and pixel shaders]
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/vulkan/draws/graphics_pipeline.h"
#include "runtime/vulkan/spirv/shader_stage.h"

namespace kaamos::vulkan {

// The location of SV_Barycentrics: that of the vertex shader's SV_Position, which is built in.
uint32_t barycentrics_location(const runtime::LinkedGraphics& linked);

// The code of the pixel shader with the locations of the vertex shader's outputs.
std::vector<uint32_t> linked_pixel_code(const runtime::LinkedGraphics& linked);

// kTargetConstant of each target.
std::vector<StageConstant> target_constants(const Gpu& gpu, const runtime::LinkedGraphics& linked,
                                            const GraphicsVariant& wanted);

}  // namespace kaamos::vulkan
