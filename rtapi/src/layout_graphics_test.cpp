// SPDX-License-Identifier: MIT
//
// Numbers and structures of graphics pipelines, targets and queries.
#include "rtapi/testing/same_layout.h"

namespace rtapi::testing {
namespace {

constexpr int kFirst = __COUNTER__;

// Constants
SAME_VALUE(rtapi::kAppendAlignedElement, D3D12_APPEND_ALIGNED_ELEMENT);
SAME_VALUE(rtapi::kIAVertexInputResourceSlotCount, D3D12_IA_VERTEX_INPUT_RESOURCE_SLOT_COUNT);
SAME_VALUE(rtapi::kViewportAndScissorRectCount,
           D3D12_VIEWPORT_AND_SCISSORRECT_OBJECT_COUNT_PER_PIPELINE);
SAME_VALUE(rtapi::kSimultaneousRenderTargetCount, D3D12_SIMULTANEOUS_RENDER_TARGET_COUNT);

// D3D12_DESCRIPTOR_HEAP_TYPE
SAME_VALUE(rtapi::DescriptorHeapType::kRtv, D3D12_DESCRIPTOR_HEAP_TYPE_RTV);
SAME_VALUE(rtapi::DescriptorHeapType::kDsv, D3D12_DESCRIPTOR_HEAP_TYPE_DSV);

// D3D12_RESOURCE_FLAG
SAME_VALUE(rtapi::ResourceFlags::kAllowRenderTarget, D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET);
SAME_VALUE(rtapi::ResourceFlags::kAllowDepthStencil, D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL);
SAME_VALUE(rtapi::ResourceFlags::kDenyShaderResource, D3D12_RESOURCE_FLAG_DENY_SHADER_RESOURCE);

// D3D12_RESOURCE_STATE
SAME_VALUE(rtapi::ResourceStates::kIndexBuffer, D3D12_RESOURCE_STATE_INDEX_BUFFER);
SAME_VALUE(rtapi::ResourceStates::kRenderTarget, D3D12_RESOURCE_STATE_RENDER_TARGET);
SAME_VALUE(rtapi::ResourceStates::kDepthWrite, D3D12_RESOURCE_STATE_DEPTH_WRITE);
SAME_VALUE(rtapi::ResourceStates::kDepthRead, D3D12_RESOURCE_STATE_DEPTH_READ);

// D3D12_RTV_DIMENSION
SAME_VALUE(rtapi::RtvDimension::kUnknown, D3D12_RTV_DIMENSION_UNKNOWN);
SAME_VALUE(rtapi::RtvDimension::kTexture2D, D3D12_RTV_DIMENSION_TEXTURE2D);
SAME_VALUE(rtapi::RtvDimension::kTexture2DArray, D3D12_RTV_DIMENSION_TEXTURE2DARRAY);

// D3D12_DSV_DIMENSION
SAME_VALUE(rtapi::DsvDimension::kUnknown, D3D12_DSV_DIMENSION_UNKNOWN);
SAME_VALUE(rtapi::DsvDimension::kTexture2D, D3D12_DSV_DIMENSION_TEXTURE2D);
SAME_VALUE(rtapi::DsvDimension::kTexture2DArray, D3D12_DSV_DIMENSION_TEXTURE2DARRAY);

// D3D12_DSV_FLAG
SAME_VALUE(rtapi::DsvFlags::kNone, D3D12_DSV_FLAG_NONE);
SAME_VALUE(rtapi::DsvFlags::kReadOnlyDepth, D3D12_DSV_FLAG_READ_ONLY_DEPTH);
SAME_VALUE(rtapi::DsvFlags::kReadOnlyStencil, D3D12_DSV_FLAG_READ_ONLY_STENCIL);

// D3D12_STENCIL_OP
SAME_VALUE(rtapi::StencilOp::kKeep, D3D12_STENCIL_OP_KEEP);
SAME_VALUE(rtapi::StencilOp::kZero, D3D12_STENCIL_OP_ZERO);
SAME_VALUE(rtapi::StencilOp::kReplace, D3D12_STENCIL_OP_REPLACE);
SAME_VALUE(rtapi::StencilOp::kIncrSat, D3D12_STENCIL_OP_INCR_SAT);
SAME_VALUE(rtapi::StencilOp::kDecrSat, D3D12_STENCIL_OP_DECR_SAT);
SAME_VALUE(rtapi::StencilOp::kInvert, D3D12_STENCIL_OP_INVERT);
SAME_VALUE(rtapi::StencilOp::kIncr, D3D12_STENCIL_OP_INCR);
SAME_VALUE(rtapi::StencilOp::kDecr, D3D12_STENCIL_OP_DECR);

// D3D12_CLEAR_FLAG
SAME_VALUE(rtapi::ClearFlags::kDepth, D3D12_CLEAR_FLAG_DEPTH);
SAME_VALUE(rtapi::ClearFlags::kStencil, D3D12_CLEAR_FLAG_STENCIL);

// D3D12_INPUT_CLASSIFICATION
SAME_VALUE(rtapi::InputClassification::kPerVertexData, D3D12_INPUT_CLASSIFICATION_PER_VERTEX_DATA);
SAME_VALUE(rtapi::InputClassification::kPerInstanceData,
           D3D12_INPUT_CLASSIFICATION_PER_INSTANCE_DATA);

// D3D12_INDEX_BUFFER_STRIP_CUT_VALUE
SAME_VALUE(rtapi::IndexBufferStripCutValue::kDisabled, D3D12_INDEX_BUFFER_STRIP_CUT_VALUE_DISABLED);
SAME_VALUE(rtapi::IndexBufferStripCutValue::k0xFFFF, D3D12_INDEX_BUFFER_STRIP_CUT_VALUE_0xFFFF);
SAME_VALUE(rtapi::IndexBufferStripCutValue::k0xFFFFFFFF,
           D3D12_INDEX_BUFFER_STRIP_CUT_VALUE_0xFFFFFFFF);

// D3D12_PRIMITIVE_TOPOLOGY_TYPE
SAME_VALUE(rtapi::PrimitiveTopologyType::kUndefined, D3D12_PRIMITIVE_TOPOLOGY_TYPE_UNDEFINED);
SAME_VALUE(rtapi::PrimitiveTopologyType::kPoint, D3D12_PRIMITIVE_TOPOLOGY_TYPE_POINT);
SAME_VALUE(rtapi::PrimitiveTopologyType::kLine, D3D12_PRIMITIVE_TOPOLOGY_TYPE_LINE);
SAME_VALUE(rtapi::PrimitiveTopologyType::kTriangle, D3D12_PRIMITIVE_TOPOLOGY_TYPE_TRIANGLE);
SAME_VALUE(rtapi::PrimitiveTopologyType::kPatch, D3D12_PRIMITIVE_TOPOLOGY_TYPE_PATCH);

// D3D_PRIMITIVE_TOPOLOGY
SAME_VALUE(rtapi::PrimitiveTopology::kUndefined, D3D_PRIMITIVE_TOPOLOGY_UNDEFINED);
SAME_VALUE(rtapi::PrimitiveTopology::kPointList, D3D_PRIMITIVE_TOPOLOGY_POINTLIST);
SAME_VALUE(rtapi::PrimitiveTopology::kLineList, D3D_PRIMITIVE_TOPOLOGY_LINELIST);
SAME_VALUE(rtapi::PrimitiveTopology::kLineStrip, D3D_PRIMITIVE_TOPOLOGY_LINESTRIP);
SAME_VALUE(rtapi::PrimitiveTopology::kTriangleList, D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
SAME_VALUE(rtapi::PrimitiveTopology::kTriangleStrip, D3D_PRIMITIVE_TOPOLOGY_TRIANGLESTRIP);

// D3D12_FILL_MODE
SAME_VALUE(rtapi::FillMode::kWireframe, D3D12_FILL_MODE_WIREFRAME);
SAME_VALUE(rtapi::FillMode::kSolid, D3D12_FILL_MODE_SOLID);

// D3D12_CULL_MODE
SAME_VALUE(rtapi::CullMode::kNone, D3D12_CULL_MODE_NONE);
SAME_VALUE(rtapi::CullMode::kFront, D3D12_CULL_MODE_FRONT);
SAME_VALUE(rtapi::CullMode::kBack, D3D12_CULL_MODE_BACK);

// D3D12_DEPTH_WRITE_MASK
SAME_VALUE(rtapi::DepthWriteMask::kZero, D3D12_DEPTH_WRITE_MASK_ZERO);
SAME_VALUE(rtapi::DepthWriteMask::kAll, D3D12_DEPTH_WRITE_MASK_ALL);

// D3D12_BLEND
SAME_VALUE(rtapi::Blend::kZero, D3D12_BLEND_ZERO);
SAME_VALUE(rtapi::Blend::kOne, D3D12_BLEND_ONE);
SAME_VALUE(rtapi::Blend::kSrcColor, D3D12_BLEND_SRC_COLOR);
SAME_VALUE(rtapi::Blend::kInvSrcColor, D3D12_BLEND_INV_SRC_COLOR);
SAME_VALUE(rtapi::Blend::kSrcAlpha, D3D12_BLEND_SRC_ALPHA);
SAME_VALUE(rtapi::Blend::kInvSrcAlpha, D3D12_BLEND_INV_SRC_ALPHA);
SAME_VALUE(rtapi::Blend::kDestAlpha, D3D12_BLEND_DEST_ALPHA);
SAME_VALUE(rtapi::Blend::kInvDestAlpha, D3D12_BLEND_INV_DEST_ALPHA);
SAME_VALUE(rtapi::Blend::kDestColor, D3D12_BLEND_DEST_COLOR);
SAME_VALUE(rtapi::Blend::kInvDestColor, D3D12_BLEND_INV_DEST_COLOR);
SAME_VALUE(rtapi::Blend::kSrcAlphaSat, D3D12_BLEND_SRC_ALPHA_SAT);
SAME_VALUE(rtapi::Blend::kBlendFactor, D3D12_BLEND_BLEND_FACTOR);
SAME_VALUE(rtapi::Blend::kInvBlendFactor, D3D12_BLEND_INV_BLEND_FACTOR);
SAME_VALUE(rtapi::Blend::kSrc1Color, D3D12_BLEND_SRC1_COLOR);
SAME_VALUE(rtapi::Blend::kInvSrc1Color, D3D12_BLEND_INV_SRC1_COLOR);
SAME_VALUE(rtapi::Blend::kSrc1Alpha, D3D12_BLEND_SRC1_ALPHA);
SAME_VALUE(rtapi::Blend::kInvSrc1Alpha, D3D12_BLEND_INV_SRC1_ALPHA);

// D3D12_BLEND_OP
SAME_VALUE(rtapi::BlendOp::kAdd, D3D12_BLEND_OP_ADD);
SAME_VALUE(rtapi::BlendOp::kSubtract, D3D12_BLEND_OP_SUBTRACT);
SAME_VALUE(rtapi::BlendOp::kRevSubtract, D3D12_BLEND_OP_REV_SUBTRACT);
SAME_VALUE(rtapi::BlendOp::kMin, D3D12_BLEND_OP_MIN);
SAME_VALUE(rtapi::BlendOp::kMax, D3D12_BLEND_OP_MAX);

// D3D12_COLOR_WRITE_ENABLE
SAME_VALUE(rtapi::ColorWriteEnable::kRed, D3D12_COLOR_WRITE_ENABLE_RED);
SAME_VALUE(rtapi::ColorWriteEnable::kGreen, D3D12_COLOR_WRITE_ENABLE_GREEN);
SAME_VALUE(rtapi::ColorWriteEnable::kBlue, D3D12_COLOR_WRITE_ENABLE_BLUE);
SAME_VALUE(rtapi::ColorWriteEnable::kAlpha, D3D12_COLOR_WRITE_ENABLE_ALPHA);
SAME_VALUE(rtapi::ColorWriteEnable::kAll, D3D12_COLOR_WRITE_ENABLE_ALL);

// D3D12_QUERY_HEAP_TYPE
SAME_VALUE(rtapi::QueryHeapType::kOcclusion, D3D12_QUERY_HEAP_TYPE_OCCLUSION);
SAME_VALUE(rtapi::QueryHeapType::kTimestamp, D3D12_QUERY_HEAP_TYPE_TIMESTAMP);
SAME_VALUE(rtapi::QueryHeapType::kPipelineStatistics, D3D12_QUERY_HEAP_TYPE_PIPELINE_STATISTICS);

// D3D12_QUERY_TYPE
SAME_VALUE(rtapi::QueryType::kOcclusion, D3D12_QUERY_TYPE_OCCLUSION);
SAME_VALUE(rtapi::QueryType::kBinaryOcclusion, D3D12_QUERY_TYPE_BINARY_OCCLUSION);
SAME_VALUE(rtapi::QueryType::kTimestamp, D3D12_QUERY_TYPE_TIMESTAMP);
SAME_VALUE(rtapi::QueryType::kPipelineStatistics, D3D12_QUERY_TYPE_PIPELINE_STATISTICS);

// Structures that are in GPU memory, or that programs fill with memcpy
SAME_SIZE(VertexBufferView, D3D12_VERTEX_BUFFER_VIEW);
SAME_OFFSET(VertexBufferView, D3D12_VERTEX_BUFFER_VIEW, BufferLocation);
SAME_OFFSET(VertexBufferView, D3D12_VERTEX_BUFFER_VIEW, SizeInBytes);
SAME_OFFSET(VertexBufferView, D3D12_VERTEX_BUFFER_VIEW, StrideInBytes);
SAME_SIZE(IndexBufferView, D3D12_INDEX_BUFFER_VIEW);
SAME_OFFSET(IndexBufferView, D3D12_INDEX_BUFFER_VIEW, BufferLocation);
SAME_OFFSET(IndexBufferView, D3D12_INDEX_BUFFER_VIEW, SizeInBytes);
SAME_OFFSET(IndexBufferView, D3D12_INDEX_BUFFER_VIEW, Format);
SAME_SIZE(Viewport, D3D12_VIEWPORT);
SAME_OFFSET(Viewport, D3D12_VIEWPORT, TopLeftX);
SAME_OFFSET(Viewport, D3D12_VIEWPORT, TopLeftY);
SAME_OFFSET(Viewport, D3D12_VIEWPORT, Width);
SAME_OFFSET(Viewport, D3D12_VIEWPORT, Height);
SAME_OFFSET(Viewport, D3D12_VIEWPORT, MinDepth);
SAME_OFFSET(Viewport, D3D12_VIEWPORT, MaxDepth);
SAME_SIZE(Rect, D3D12_RECT);
SAME_OFFSET(Rect, D3D12_RECT, left);
SAME_OFFSET(Rect, D3D12_RECT, top);
SAME_OFFSET(Rect, D3D12_RECT, right);
SAME_OFFSET(Rect, D3D12_RECT, bottom);
SAME_SIZE(DrawArguments, D3D12_DRAW_ARGUMENTS);
SAME_OFFSET(DrawArguments, D3D12_DRAW_ARGUMENTS, VertexCountPerInstance);
SAME_OFFSET(DrawArguments, D3D12_DRAW_ARGUMENTS, InstanceCount);
SAME_OFFSET(DrawArguments, D3D12_DRAW_ARGUMENTS, StartVertexLocation);
SAME_OFFSET(DrawArguments, D3D12_DRAW_ARGUMENTS, StartInstanceLocation);
SAME_SIZE(DrawIndexedArguments, D3D12_DRAW_INDEXED_ARGUMENTS);
SAME_OFFSET(DrawIndexedArguments, D3D12_DRAW_INDEXED_ARGUMENTS, IndexCountPerInstance);
SAME_OFFSET(DrawIndexedArguments, D3D12_DRAW_INDEXED_ARGUMENTS, InstanceCount);
SAME_OFFSET(DrawIndexedArguments, D3D12_DRAW_INDEXED_ARGUMENTS, StartIndexLocation);
SAME_OFFSET(DrawIndexedArguments, D3D12_DRAW_INDEXED_ARGUMENTS, BaseVertexLocation);
SAME_OFFSET(DrawIndexedArguments, D3D12_DRAW_INDEXED_ARGUMENTS, StartInstanceLocation);

constexpr int kChecks = __COUNTER__ - kFirst - 1;

}  // namespace

int layout_graphics() {
  return kChecks;
}

}  // namespace rtapi::testing
