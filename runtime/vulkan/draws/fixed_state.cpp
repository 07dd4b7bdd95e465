// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/fixed_state.h"

namespace kaamos::vulkan {
namespace {

using rtapi::Blend;

VkBlendFactor factor_of(Blend blend) {
  switch (blend) {
    case Blend::kZero:
      return VK_BLEND_FACTOR_ZERO;
    case Blend::kSrcColor:
      return VK_BLEND_FACTOR_SRC_COLOR;
    case Blend::kInvSrcColor:
      return VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR;
    case Blend::kSrcAlpha:
      return VK_BLEND_FACTOR_SRC_ALPHA;
    case Blend::kInvSrcAlpha:
      return VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    case Blend::kDestAlpha:
      return VK_BLEND_FACTOR_DST_ALPHA;
    case Blend::kInvDestAlpha:
      return VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA;
    case Blend::kDestColor:
      return VK_BLEND_FACTOR_DST_COLOR;
    case Blend::kInvDestColor:
      return VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR;
    case Blend::kSrcAlphaSat:
      return VK_BLEND_FACTOR_SRC_ALPHA_SATURATE;
    case Blend::kSrc1Color:
      return VK_BLEND_FACTOR_SRC1_COLOR;
    case Blend::kInvSrc1Color:
      return VK_BLEND_FACTOR_ONE_MINUS_SRC1_COLOR;
    case Blend::kSrc1Alpha:
      return VK_BLEND_FACTOR_SRC1_ALPHA;
    case Blend::kInvSrc1Alpha:
      return VK_BLEND_FACTOR_ONE_MINUS_SRC1_ALPHA;
    case Blend::kBlendFactor:
      return VK_BLEND_FACTOR_CONSTANT_COLOR;
    case Blend::kInvBlendFactor:
      return VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR;
    default:
      return VK_BLEND_FACTOR_ONE;
  }
}

bool stores_alpha(rtapi::Format format) {
  return rtapi::GetFormatInfo(format).channels == 4 && format != rtapi::Format::kB8G8R8X8Unorm &&
         format != rtapi::Format::kB8G8R8X8UnormSrgb;
}

// Absent alpha reads 1. [RAS-121]
VkBlendFactor factor_at(Blend blend, rtapi::Format format) {
  if (!stores_alpha(format)) {
    if (blend == Blend::kDestAlpha) return VK_BLEND_FACTOR_ONE;
    if (blend == Blend::kInvDestAlpha) return VK_BLEND_FACTOR_ZERO;
  }
  return factor_of(blend);
}

// Both count the same operations, D3D from 1 and Vulkan from 0.
VkBlendOp op_of(rtapi::BlendOp op) {
  return static_cast<VkBlendOp>(static_cast<uint32_t>(op) - 1);
}
VkLogicOp logic_op(rtapi::LogicOp op) {
  constexpr VkLogicOp kOps[] = {
      VK_LOGIC_OP_CLEAR,         VK_LOGIC_OP_SET,          VK_LOGIC_OP_COPY,
      VK_LOGIC_OP_COPY_INVERTED, VK_LOGIC_OP_NO_OP,        VK_LOGIC_OP_INVERT,
      VK_LOGIC_OP_AND,           VK_LOGIC_OP_NAND,         VK_LOGIC_OP_OR,
      VK_LOGIC_OP_NOR,           VK_LOGIC_OP_XOR,          VK_LOGIC_OP_EQUIVALENT,
      VK_LOGIC_OP_AND_REVERSE,   VK_LOGIC_OP_AND_INVERTED, VK_LOGIC_OP_OR_REVERSE,
      VK_LOGIC_OP_OR_INVERTED};
  return kOps[static_cast<uint32_t>(op)];
}
VkCompareOp compare_op(rtapi::ComparisonFunc func) {
  return static_cast<VkCompareOp>(static_cast<uint32_t>(func) - 1);
}
VkStencilOp stencil_op(rtapi::StencilOp op) {
  return static_cast<VkStencilOp>(static_cast<uint32_t>(op) - 1);
}
static_assert(VK_STENCIL_OP_DECREMENT_AND_WRAP == static_cast<int>(rtapi::StencilOp::kDecr) - 1);
static_assert(VK_BLEND_OP_MAX == static_cast<int>(rtapi::BlendOp::kMax) - 1);
static_assert(VK_COMPARE_OP_GREATER_OR_EQUAL ==
              static_cast<int>(rtapi::ComparisonFunc::kGreaterEqual) - 1);

VkPipelineColorBlendAttachmentState blend_state(const rtapi::RenderTargetBlendDesc& desc,
                                                rtapi::Format format) {
  VkPipelineColorBlendAttachmentState state = {};
  state.colorWriteMask = static_cast<VkColorComponentFlags>(desc.RenderTargetWriteMask);
  state.blendEnable = desc.BlendEnable;
  if (!desc.BlendEnable) return state;
  state.srcColorBlendFactor = factor_at(desc.SrcBlend, format);
  state.dstColorBlendFactor = factor_at(desc.DestBlend, format);
  state.colorBlendOp = op_of(desc.BlendOp);
  state.srcAlphaBlendFactor = factor_at(desc.SrcBlendAlpha, format);
  state.dstAlphaBlendFactor = factor_at(desc.DestBlendAlpha, format);
  state.alphaBlendOp = op_of(desc.BlendOpAlpha);
  return state;
}

// The write mask and the reference are dynamic.
VkStencilOpState stencil_state(const rtapi::DepthStencilOpDesc& desc) {
  VkStencilOpState state = {};
  state.failOp = stencil_op(desc.StencilFailOp);
  state.depthFailOp = stencil_op(desc.StencilDepthFailOp);
  state.passOp = stencil_op(desc.StencilPassOp);
  state.compareOp = compare_op(desc.StencilFunc);
  state.compareMask = desc.StencilReadMask;
  return state;
}

// A list chooses a topology of this class when it draws.
VkPrimitiveTopology topology_class(rtapi::PrimitiveTopologyType type) {
  switch (type) {
    case rtapi::PrimitiveTopologyType::kPoint:
      return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    case rtapi::PrimitiveTopologyType::kLine:
      return VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
    default:
      return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  }
}

VkCullModeFlags cull_mode(rtapi::CullMode mode) {
  switch (mode) {
    case rtapi::CullMode::kFront:
      return VK_CULL_MODE_FRONT_BIT;
    case rtapi::CullMode::kBack:
      return VK_CULL_MODE_BACK_BIT;
    default:
      return VK_CULL_MODE_NONE;
  }
}

}  // namespace

FixedState::FixedState(const Gpu& gpu, const runtime::LinkedGraphics& linked,
                       const GraphicsVariant& wanted)
    : sample_mask(linked.sample_mask) {
  assembly.topology = topology_class(linked.topology);

  // Depth is limited to the viewport's range in any case. [RAS-42]
  depth_clip.depthClipEnable = linked.rasterizer.DepthClipEnable;
  const bool draws_lines = linked.drawn() == rtapi::PrimitiveTopologyType::kLine ||
                           linked.rasterizer.FillMode == rtapi::FillMode::kWireframe;
  const bool rectangles = draws_lines && linked.rasterizer.MultisampleEnable;
  lines.lineRasterizationMode = rectangles ? VK_LINE_RASTERIZATION_MODE_RECTANGULAR_EXT
                                           : VK_LINE_RASTERIZATION_MODE_BRESENHAM_EXT;
  lines.pNext = &depth_clip;
  rasterizer.pNext = &depth_clip;
  // Vulkan has no such lines with alpha to coverage. [VUID-...-lineRasterizationMode-02766]
  if (rectangles || (draws_lines && !linked.alpha_to_coverage)) rasterizer.pNext = &lines;
  rasterizer.depthClampEnable = VK_TRUE;
  rasterizer.polygonMode = linked.rasterizer.FillMode == rtapi::FillMode::kWireframe
                               ? VK_POLYGON_MODE_LINE
                               : VK_POLYGON_MODE_FILL;
  rasterizer.cullMode = cull_mode(linked.rasterizer.CullMode);
  rasterizer.frontFace = linked.rasterizer.FrontCounterClockwise ? VK_FRONT_FACE_COUNTER_CLOCKWISE
                                                                 : VK_FRONT_FACE_CLOCKWISE;
  rasterizer.lineWidth = rectangles ? 1.4f : 1.0f;
  const float bias = static_cast<float>(linked.rasterizer.DepthBias);
  const bool unorm =
      wanted.depth == rtapi::Format::kD16Unorm || wanted.depth == rtapi::Format::kD24UnormS8Uint;
  const bool twice = unorm && gpu.workarounds().has(Workaround::kHalveDepthBias);
  rasterizer.depthBiasConstantFactor = twice ? bias * 0.5f : bias;
  rasterizer.depthBiasSlopeFactor = linked.rasterizer.SlopeScaledDepthBias;
  rasterizer.depthBiasClamp = linked.rasterizer.DepthBiasClamp;
  rasterizer.depthBiasEnable = bias != 0 || linked.rasterizer.SlopeScaledDepthBias != 0;

  samples.rasterizationSamples = static_cast<VkSampleCountFlagBits>(linked.samples);
  samples.alphaToCoverageEnable = linked.alpha_to_coverage;
  samples.pSampleMask = &sample_mask;

  depth.depthTestEnable =
      linked.depth_stencil.DepthEnable && wanted.depth != rtapi::Format::kUnknown;
  if (depth.depthTestEnable) depth.depthCompareOp = compare_op(linked.depth_stencil.DepthFunc);
  depth.stencilTestEnable = linked.depth_stencil.StencilEnable && rtapi::HasStencil(wanted.depth);
  if (depth.stencilTestEnable) {
    depth.front = stencil_state(linked.depth_stencil.FrontFace);
    depth.back = stencil_state(linked.depth_stencil.BackFace);
  }

  for (uint32_t i = 0; i < wanted.color_count; ++i) {
    const bool written =
        linked.has_pixel() && linked.pixel_columns.targets[i].first_column != runtime::kNoColumn;
    // A target that the pixel shader does not write keeps its contents. [RAS-110]
    if (written && wanted.colors[i] != rtapi::Format::kUnknown) {
      targets[i] = blend_state(linked.blend[i], wanted.colors[i]);
    }
  }
  blend.logicOpEnable = linked.blend[0].LogicOpEnable;
  blend.logicOp = logic_op(linked.blend[0].LogicOp);
  blend.attachmentCount = wanted.color_count;
  blend.pAttachments = targets.data();
}

}  // namespace kaamos::vulkan
