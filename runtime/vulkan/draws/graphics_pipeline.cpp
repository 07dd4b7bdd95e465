// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/graphics_pipeline.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "kaamos/shader/spirv_interface.h"
#include "runtime/backend/errors.h"
#include "runtime/vulkan/draws/barycentrics_stage.h"
#include "runtime/vulkan/draws/fixed_state.h"
#include "runtime/vulkan/draws/stage_linkage.h"
#include "runtime/vulkan/spirv/shader_stage.h"
#include "runtime/vulkan/textures/texture_format.h"

namespace kaamos::vulkan {
namespace {

constexpr VkDynamicState kDynamicStates[] = {VK_DYNAMIC_STATE_VIEWPORT_WITH_COUNT,
                                             VK_DYNAMIC_STATE_SCISSOR_WITH_COUNT,
                                             VK_DYNAMIC_STATE_BLEND_CONSTANTS,
                                             VK_DYNAMIC_STATE_PRIMITIVE_TOPOLOGY,
                                             VK_DYNAMIC_STATE_PRIMITIVE_RESTART_ENABLE,
                                             VK_DYNAMIC_STATE_DEPTH_WRITE_ENABLE,
                                             VK_DYNAMIC_STATE_STENCIL_WRITE_MASK,
                                             VK_DYNAMIC_STATE_STENCIL_REFERENCE,
                                             VK_DYNAMIC_STATE_VERTEX_INPUT_BINDING_STRIDE};
constexpr uint32_t kDynamicStateCount = std::size(kDynamicStates);

// The vertex buffers as VkPipelineVertexInputStateCreateInfo takes them.
struct VertexInputState {
  std::vector<VkVertexInputBindingDescription> bindings;
  std::vector<VkVertexInputAttributeDescription> attributes;
  std::vector<VkVertexInputBindingDivisorDescriptionEXT> divisors;
  VkPipelineVertexInputDivisorStateCreateInfoEXT divisor_info = {
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_DIVISOR_STATE_CREATE_INFO_EXT};
  VkPipelineVertexInputStateCreateInfo info = {
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};

  VertexInputState(const VertexInput& inputs, const GraphicsVariant& wanted) {
    for (uint32_t i = 0; i < inputs.bindings.size(); ++i) {
      const VertexBinding& binding = inputs.bindings[i];
      bindings.push_back(
          {i, wanted.strides.empty() ? 0 : wanted.strides[i],
           binding.per_instance ? VK_VERTEX_INPUT_RATE_INSTANCE : VK_VERTEX_INPUT_RATE_VERTEX});
      if (binding.per_instance && binding.step_rate != 1) {
        divisors.push_back({i, binding.step_rate});
      }
    }
    attributes = inputs.attributes;
    for (size_t i = 0; i < attributes.size(); ++i) {
      if ((wanted.unbound >> attributes[i].binding & 1) == 0) continue;
      attributes[i].format = inputs.zero_formats[i];
      attributes[i].offset = 0;
    }
    divisor_info.vertexBindingDivisorCount = static_cast<uint32_t>(divisors.size());
    divisor_info.pVertexBindingDivisors = divisors.data();
    if (!divisors.empty()) info.pNext = &divisor_info;
    info.vertexBindingDescriptionCount = static_cast<uint32_t>(bindings.size());
    info.pVertexBindingDescriptions = bindings.data();
    info.vertexAttributeDescriptionCount = static_cast<uint32_t>(attributes.size());
    info.pVertexAttributeDescriptions = attributes.data();
  }
  VertexInputState(const VertexInputState&) = delete;
  VertexInputState& operator=(const VertexInputState&) = delete;
};

VkFormat format_of_target(rtapi::Format format) {
  return format == rtapi::Format::kUnknown ? VK_FORMAT_UNDEFINED : texture_format(format).format;
}

}  // namespace

rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> GraphicsPipeline::create(
    std::shared_ptr<PipelineLayout> layout, std::shared_ptr<const runtime::LinkedGraphics> linked) {
  std::shared_ptr<GraphicsPipeline> pipeline(
      new GraphicsPipeline(std::move(layout), std::move(linked)));
  if (auto s = pipeline->start(); !s) return s.error();
  return std::shared_ptr<runtime::BackendPipeline>(std::move(pipeline));
}

GraphicsPipeline::~GraphicsPipeline() {
  Gpu& gpu = layout_->gpu();
  for (const Made& made : variants_) {
    gpu.vk().vkDestroyPipeline(gpu.device(), made.handle, nullptr);
  }
}

rtapi::Status GraphicsPipeline::start() {
  const Gpu& gpu = layout_->gpu();
  if (!gpu.features().graphics_lacks.empty()) {
    return runtime::make_error(runtime::Id::kNoGraphics,
                               gpu.info().Name + " lacks " + gpu.features().graphics_lacks + ".");
  }
  const bool has_waves =
      linked_->has_pixel() && (linked_->pixel_desc().flags & shader::kGraphicsReadsWave) != 0;
  if (has_waves) {
    auto s = check_subgroups(gpu, VK_SHADER_STAGE_FRAGMENT_BIT, "pixel", linked_->pixel.name);
    if (!s) return s;
  }
  auto inputs = vertex_input(gpu, *linked_);
  if (!inputs) return inputs.error();
  inputs_ = *std::move(inputs);
  if (linked_->has_pixel() && linked_->pixel.code->spirv != nullptr) {
    pixel_code_ = linked_pixel_code(*linked_);
  }
  if (linked_->has_geometry() && linked_->geometry.code->spirv != nullptr) {
    geometry_code_ = linked_geometry_code(*linked_);
  }
  const std::vector<VertexAttribute> attributes = vertex_attributes(*linked_);
  if (linked_->pixel_columns.barycentrics != runtime::kNoColumn || !attributes.empty()) {
    if (gpu.is_lavapipe() && !gpu.workarounds().has(Workaround::kBarycentricsStage)) {
      return runtime::make_error(runtime::Id::kNoBarycentrics,
                                 "pixel shader \"" + linked_->pixel.name + "\" of \"" +
                                     linked_->name +
                                     "\" reads SV_Barycentrics or calls GetAttributeAtVertex, and "
                                     "workaround BARY is off.");
    }
    // The stage that hands them on takes triangles.
    if (linked_->has_geometry()) {
      return runtime::make_error(runtime::Id::kNoBarycentrics,
                                 "pixel shader \"" + linked_->pixel.name + "\" of \"" +
                                     linked_->name +
                                     "\" reads SV_Barycentrics or calls GetAttributeAtVertex "
                                     "behind a geometry shader.");
    }
    if (linked_->topology != rtapi::PrimitiveTopologyType::kTriangle) {
      return runtime::make_error(runtime::Id::kNoBarycentrics,
                                 "pixel shader \"" + linked_->pixel.name + "\" of \"" +
                                     linked_->name +
                                     "\" reads SV_Barycentrics or calls GetAttributeAtVertex, and "
                                     "draws points or lines.");
    }
    if (!attributes.empty() && attributes.back().location >= kLocationCount) {
      return runtime::make_error(
          runtime::Id::kNoBarycentrics,
          "pixel shader \"" + linked_->pixel.name + "\" of \"" + linked_->name +
              "\" reads more attributes at vertices than there are locations beside the vertex "
              "shader's outputs.");
    }
    barycentrics_code_ = barycentrics_code(*linked_);
  }
  GraphicsVariant first;
  std::copy_n(linked_->target_formats, first.colors.size(), first.colors.begin());
  first.color_count = linked_->target_count;
  first.depth = linked_->depth_format;
  first.layers = needs_layers() ? 1 : 0;
  auto made = variant(first);
  if (!made) return made.error();
  return {};
}

bool GraphicsPipeline::needs_layers() const {
  return !barycentrics_code_.empty() &&
         linked_->vertex_columns.target_array_index != runtime::kNoColumn;
}

bool GraphicsPipeline::pixels_write_memory() const {
  return linked_->has_pixel() && (linked_->pixel_desc().flags & shader::kGraphicsWritesMemory) != 0;
}

rtapi::Result<VkPipeline> GraphicsPipeline::variant(const GraphicsVariant& wanted) {
  const std::lock_guard lock(mutex_);
  for (const Made& made : variants_) {
    if (made.variant == wanted) return made.handle;
  }
  auto handle = create_variant(wanted);
  if (handle) variants_.push_back({wanted, *handle});
  return handle;
}

rtapi::Result<VkPipeline> GraphicsPipeline::create_variant(const GraphicsVariant& wanted) {
  Gpu& gpu = layout_->gpu();
  StageOptions options;
  options.count = layout_->collect_statistics();
  StageList stages(gpu, options);
  if (auto added = stages.add(linked_->vertex); !added) return added.error();
  if (linked_->has_pixel()) {
    auto added = stages.add(linked_->pixel, pixel_code_, target_constants(gpu, *linked_, wanted));
    if (!added) return added.error();
  }
  if (linked_->has_geometry()) {
    auto added = stages.add(linked_->geometry, geometry_code_, {});
    if (!added) return added.error();
  }
  if (!barycentrics_code_.empty()) {
    const StageConstant layers = {0, wanted.layers};
    stages.add(barycentrics_code_, VK_SHADER_STAGE_GEOMETRY_BIT, std::span(&layers, 1));
  }
  if (auto s = stages.create_modules(); !s) return s.error();
  const VertexInputState vertices(inputs_, wanted);
  const FixedState fixed(gpu, *linked_, wanted);
  std::array<VkFormat, rtapi::kSimultaneousRenderTargetCount> formats = {};
  std::transform(wanted.colors.begin(), wanted.colors.end(), formats.begin(), format_of_target);
  VkPipelineRenderingCreateInfo rendering = {VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = wanted.color_count;
  rendering.pColorAttachmentFormats = formats.data();
  rendering.depthAttachmentFormat = format_of_target(wanted.depth);
  if (rtapi::HasStencil(wanted.depth)) {
    rendering.stencilAttachmentFormat = rendering.depthAttachmentFormat;
  }
  VkPipelineDynamicStateCreateInfo dynamic = {VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  const bool strides_come = wanted.strides.empty() && !inputs_.bindings.empty();
  dynamic.dynamicStateCount = strides_come ? kDynamicStateCount : kDynamicStateCount - 1;
  dynamic.pDynamicStates = kDynamicStates;
  VkGraphicsPipelineCreateInfo info = {VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
  info.pNext = &rendering;
  info.stageCount = static_cast<uint32_t>(stages.stages().size());
  info.pStages = stages.stages().data();
  info.pVertexInputState = &vertices.info;
  info.pInputAssemblyState = &fixed.assembly;
  info.pViewportState = &fixed.viewports;
  info.pRasterizationState = &fixed.rasterizer;
  info.pMultisampleState = &fixed.samples;
  info.pDepthStencilState = &fixed.depth;
  info.pColorBlendState = &fixed.blend;
  info.pDynamicState = &dynamic;
  info.layout = layout_->handle();
  VkPipeline handle = VK_NULL_HANDLE;
  const VkResult r =
      gpu.vk().vkCreateGraphicsPipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle);
  if (r != VK_SUCCESS) return gpu.error(r, "graphics pipeline \"" + linked_->name + "\"");
  return handle;
}

}  // namespace kaamos::vulkan
