// SPDX-License-Identifier: MIT
//
// Rasterizer, tests of depth and stencil, blending and masks of a graphics pipeline, in Vulkan's
// terms.
#pragma once

#include <array>

#include "runtime/vulkan/draws/graphics_pipeline.h"

namespace kaamos::vulkan {

// Must not be moved, because its structures point to each other.
struct FixedState {
  FixedState(const Gpu& gpu, const runtime::LinkedGraphics& linked, const GraphicsVariant& wanted);
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;

  VkPipelineInputAssemblyStateCreateInfo assembly = {
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  VkPipelineViewportStateCreateInfo viewports = {
      VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  VkPipelineRasterizationDepthClipStateCreateInfoEXT depth_clip = {
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_DEPTH_CLIP_STATE_CREATE_INFO_EXT};
  VkPipelineRasterizationLineStateCreateInfoEXT lines = {
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_LINE_STATE_CREATE_INFO_EXT};
  VkPipelineRasterizationStateCreateInfo rasterizer = {
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  VkSampleMask sample_mask = 0;
  VkPipelineMultisampleStateCreateInfo samples = {
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  VkPipelineDepthStencilStateCreateInfo depth = {
      VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  std::array<VkPipelineColorBlendAttachmentState, rtapi::kSimultaneousRenderTargetCount> targets =
      {};
  VkPipelineColorBlendStateCreateInfo blend = {
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
};

}  // namespace kaamos::vulkan
