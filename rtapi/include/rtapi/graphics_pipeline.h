// SPDX-License-Identifier: MIT
/// @file
/// Graphics pipelines: what a draw does besides running shaders.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <rtapi/descriptor.h>
#include <rtapi/format.h>
#include <rtapi/resource.h>
#include <rtapi/root_signature.h>
#include <rtapi/shader_library.h>
#include <rtapi/types.h>

namespace rtapi {

// ---------------------------------------------------------------------------------------------
// Input assembler

/// Tells whether an element changes with the vertex or with the instance.
/// [D3D12: D3D12_INPUT_CLASSIFICATION]
enum class InputClassification : uint32_t { kPerVertexData = 0, kPerInstanceData = 1 };

/// InputElementDesc::AlignedByteOffset: behind the element before it in the same slot, aligned to 4
/// bytes or to the element, whichever is less. [D3D12: D3D12_APPEND_ALIGNED_ELEMENT]
inline constexpr uint32_t kAppendAlignedElement = 0xFFFFFFFFu;

/// One input of the vertex shader and where it lies in a vertex buffer.
/// [D3D12: D3D12_INPUT_ELEMENT_DESC]
struct InputElementDesc {
  std::string SemanticName = {};                   ///< as in HLSL, in any case, without the number
  uint32_t SemanticIndex = 0;                      ///< the number behind the name
  rtapi::Format Format = rtapi::Format::kUnknown;  ///< float inputs: FLOAT, UNORM, SNORM; else *INT
  uint32_t InputSlot = 0;                          ///< vertex buffer: 0 to 31
  uint32_t AlignedByteOffset = kAppendAlignedElement;  ///< from the start of a vertex
  /// With the vertex or with the instance; all elements of a slot alike.
  InputClassification InputSlotClass = InputClassification::kPerVertexData;
  /// Instances that use an element before the next one; 0: all use the first. Vertices: 0.
  uint32_t InstanceDataStepRate = 0;
};

/// The index that ends a strip of lines or triangles, whatever the format of the index buffer.
/// [D3D12: D3D12_INDEX_BUFFER_STRIP_CUT_VALUE]
enum class IndexBufferStripCutValue : uint32_t { kDisabled = 0, k0xFFFF = 1, k0xFFFFFFFF = 2 };

/// The kind of primitives that a pipeline draws. [D3D12: D3D12_PRIMITIVE_TOPOLOGY_TYPE]
enum class PrimitiveTopologyType : uint32_t {
  kUndefined = 0,  ///< refused (KA0720)
  kPoint = 1,      ///< squares of one pixel, the vertex in their middle
  kLine = 2,
  kTriangle = 3,
  kPatch = 4,  ///< refused (KA0721)
};

/// The way in which a draw's vertices form primitives: those of the pipeline's
/// PrimitiveTopologyType, or the draw is refused (KA0740). [D3D12: D3D12_PRIMITIVE_TOPOLOGY]
enum class PrimitiveTopology : uint32_t {
  kUndefined = 0,
  kPointList = 1,
  kLineList = 2,
  kLineStrip = 3,
  kTriangleList = 4,
  kTriangleStrip = 5,
};

/// Most vertex buffers of a list, and elements of a layout. [D3D12: hardware limits]
inline constexpr uint32_t kIAVertexInputResourceSlotCount = 32;
/// Most viewports and scissor rectangles of a list.
/// [D3D12: D3D12_VIEWPORT_AND_SCISSORRECT_OBJECT_COUNT_PER_PIPELINE]
inline constexpr uint32_t kViewportAndScissorRectCount = 16;
/// Most render targets of a draw. [D3D12: D3D12_SIMULTANEOUS_RENDER_TARGET_COUNT]
inline constexpr uint32_t kSimultaneousRenderTargetCount = 8;

/// Vertices in memory, for CommandList::IASetVertexBuffers. [D3D12: D3D12_VERTEX_BUFFER_VIEW]
struct VertexBufferView {
  GpuVirtualAddress BufferLocation = 0;  ///< of the first vertex; 0: a null view, which reads zeros
  uint32_t SizeInBytes = 0;              ///< reads past it give zeros
  uint32_t StrideInBytes = 0;  ///< from vertex to vertex: 0 to 2048; 0: all read the first
};

/// Indices in memory, for CommandList::IASetIndexBuffer. [D3D12: D3D12_INDEX_BUFFER_VIEW]
struct IndexBufferView {
  GpuVirtualAddress BufferLocation = 0;  ///< a multiple of the index's size; 0: a null view
  uint32_t SizeInBytes = 0;              ///< indices past it are 0
  rtapi::Format Format = rtapi::Format::kUnknown;  ///< kR16Uint or kR32Uint
};

// ---------------------------------------------------------------------------------------------
// Rasterizer

/// The way in which triangles are filled. [D3D12: D3D12_FILL_MODE]
enum class FillMode : uint32_t {
  kWireframe = 2,  ///< the edges of each triangle that is not culled, as lines
  kSolid = 3,
};

/// The triangles that are left out. Those without area always are. [D3D12: D3D12_CULL_MODE]
enum class CullMode : uint32_t { kNone = 1, kFront = 2, kBack = 3 };

/// Describes the rasterizer. [D3D12: D3D12_RASTERIZER_DESC]
struct RasterizerDesc {
  rtapi::FillMode FillMode = rtapi::FillMode::kSolid;  ///< of triangles
  rtapi::CullMode CullMode = rtapi::CullMode::kBack;   ///< seen from the viewer
  bool FrontCounterClockwise = false;                  ///< on the screen, y down
  /// Added to the depth of a triangle and of its edges, in steps of the depth format; of D32_FLOAT
  /// in units of 2^(exponent of its largest depth - 23). [D3D11.3: 15.10]
  int32_t DepthBias = 0;
  float DepthBiasClamp = 0;  ///< the largest bias, or if negative the least; 0: no limit
  /// Times the larger of |dz/dx| and |dz/dy|, per pixel.
  float SlopeScaledDepthBias = 0;
  /// True if triangles are cut at depth 0 and 1; else only their depth is limited to the viewport's
  /// range, as it always is.
  bool DepthClipEnable = true;
  /// For lines alone: triangles are multisampled where targets are. True: lines are rectangles 1.4
  /// pixels wide. False: one pixel in each column or row that a line crosses, with all of its
  /// samples. [D3D11.3: 3.4.3, 15.14]
  bool MultisampleEnable = false;
};

// ---------------------------------------------------------------------------------------------
// Depth and blending

/// Tells whether pixels that pass the depth test write their depth. [D3D12: D3D12_DEPTH_WRITE_MASK]
enum class DepthWriteMask : uint32_t { kZero = 0, kAll = 1 };

/// What becomes of a stored stencil value, 0 to 255. [D3D12: D3D12_STENCIL_OP]
enum class StencilOp : uint32_t {
  kKeep = 1,
  kZero = 2,
  kReplace = 3,  ///< by the reference of CommandList::OMSetStencilRef
  kIncrSat = 4,  ///< 1 more; 255 stays
  kDecrSat = 5,  ///< 1 less; 0 stays
  kInvert = 6,   ///< every bit
  kIncr = 7,     ///< 1 more; 255 becomes 0
  kDecr = 8,     ///< 1 less; 0 becomes 255
};

/// The stencil test of triangles that face one way: a pixel passes if (reference & StencilReadMask)
/// StencilFunc (stored & StencilReadMask) holds. [D3D12: D3D12_DEPTH_STENCILOP_DESC1]
struct DepthStencilOpDesc {
  StencilOp StencilFailOp = StencilOp::kKeep;            ///< if the stencil test fails
  StencilOp StencilDepthFailOp = StencilOp::kKeep;       ///< if it passes and the depth test fails
  StencilOp StencilPassOp = StencilOp::kKeep;            ///< if both pass
  ComparisonFunc StencilFunc = ComparisonFunc::kAlways;  ///< unsigned
  uint8_t StencilReadMask = 0xFF;                        ///< bits that are compared
  uint8_t StencilWriteMask = 0xFF;                       ///< bits that operations change
};

/// Describes the depth test, in which a pixel passes if its depth compared with the stored one
/// holds, and the stencil test before it. Both pass where there is no depth-stencil view, and the
/// stencil test where the view's format has no stencil. A pixel that the shader discards changes
/// neither, unless the shader has [earlydepthstencil]. [D3D12: D3D12_DEPTH_STENCIL_DESC2]
struct DepthStencilDesc {
  bool DepthEnable = true;                                         ///< false: no test and no write
  rtapi::DepthWriteMask DepthWriteMask = DepthWriteMask::kAll;     ///< whether to write
  rtapi::ComparisonFunc DepthFunc = rtapi::ComparisonFunc::kLess;  ///< new depth DepthFunc stored
  bool StencilEnable = false;         ///< false: no stencil test, and no operation
  DepthStencilOpDesc FrontFace = {};  ///< of triangles that are front facing
  DepthStencilOpDesc BackFace = {};   ///< of the others
};

/// A factor of blending. [D3D12: D3D12_BLEND]
enum class Blend : uint32_t {
  kZero = 1,
  kOne = 2,
  kSrcColor = 3,
  kInvSrcColor = 4,
  kSrcAlpha = 5,
  kInvSrcAlpha = 6,
  kDestAlpha = 7,
  kInvDestAlpha = 8,
  kDestColor = 9,
  kInvDestColor = 10,
  kSrcAlphaSat = 11,
  kBlendFactor = 14,
  kInvBlendFactor = 15,
  /// Of SV_Target1, the second source of render target 0; the shader writes no other (KA0720).
  ///@{
  kSrc1Color = 16,
  kInvSrc1Color = 17,
  kSrc1Alpha = 18,
  kInvSrc1Alpha = 19,
  ///@}
};

/// The operation that joins source and destination; kMin and kMax ignore the factors.
/// [D3D12: D3D12_BLEND_OP]
enum class BlendOp : uint32_t { kAdd = 1, kSubtract = 2, kRevSubtract = 3, kMin = 4, kMax = 5 };

/// What becomes of the bits s of a source and d of a destination. [D3D12: D3D12_LOGIC_OP]
enum class LogicOp : uint32_t {
  kClear = 0,         ///< 0
  kSet = 1,           ///< 1
  kCopy = 2,          ///< s
  kCopyInverted = 3,  ///< ~s
  kNoop = 4,          ///< d
  kInvert = 5,        ///< ~d
  kAnd = 6,           ///< s & d
  kNand = 7,          ///< ~(s & d)
  kOr = 8,            ///< s | d
  kNor = 9,           ///< ~(s | d)
  kXor = 10,          ///< s ^ d
  kEquiv = 11,        ///< ~(s ^ d)
  kAndReverse = 12,   ///< s & ~d
  kAndInverted = 13,  ///< ~s & d
  kOrReverse = 14,    ///< s | ~d
  kOrInverted = 15,   ///< ~s | d
};

/// Components that are written. [D3D12: D3D12_COLOR_WRITE_ENABLE]
enum class ColorWriteEnable : uint8_t {
  kNone = 0,
  kRed = 1,
  kGreen = 2,
  kBlue = 4,
  kAlpha = 8,
  kAll = 15,
};
template <>
inline constexpr bool kIsFlags<ColorWriteEnable> = true;

/// Describes how a render target takes colours. [D3D12: D3D12_RENDER_TARGET_BLEND_DESC]
struct RenderTargetBlendDesc {
  bool BlendEnable = false;  ///< false: the source replaces the destination
  /// True: LogicOp joins the bits of source and destination. Of UINT formats (KA0726), without
  /// BlendEnable and IndependentBlendEnable (KA0720). [D3D12: D3D12_BLEND_DESC]
  bool LogicOpEnable = false;
  Blend SrcBlend = Blend::kOne;                   ///< of red, green and blue
  Blend DestBlend = Blend::kZero;                 ///< of red, green and blue
  rtapi::BlendOp BlendOp = rtapi::BlendOp::kAdd;  ///< of red, green and blue
  Blend SrcBlendAlpha = Blend::kOne;              ///< of alpha; no factor with Color in its name
  Blend DestBlendAlpha = Blend::kZero;            ///< of alpha; no factor with Color in its name
  rtapi::BlendOp BlendOpAlpha = rtapi::BlendOp::kAdd;               ///< of alpha
  rtapi::LogicOp LogicOp = rtapi::LogicOp::kNoop;                   ///< if LogicOpEnable
  ColorWriteEnable RenderTargetWriteMask = ColorWriteEnable::kAll;  ///< also without blending
};

/// Describes how all render targets take colours. [D3D12: D3D12_BLEND_DESC]
struct BlendDesc {
  /// True if a pixel keeps about as many of its samples as the alpha of SV_Target0 says: none at 0,
  /// all at 1. [D3D11.3: 17.5 Alpha-to-coverage]
  bool AlphaToCoverageEnable = false;
  bool IndependentBlendEnable = false;  ///< false: RenderTarget[0] holds for all
  /// By render target.
  std::array<RenderTargetBlendDesc, kSimultaneousRenderTargetCount> RenderTarget = {};
};

// ---------------------------------------------------------------------------------------------
// The pipeline

/// A shader of a graphics pipeline: an export of a library. [D3D12: D3D12_SHADER_BYTECODE]
struct GraphicsShader {
  ShaderLibrary Library = {};   ///< where it is; empty: no such shader
  std::string EntryPoint = {};  ///< an export of the stage; empty: the library's only one
};

/// Describes a graphics pipeline for Device::CreateGraphicsPipelineState.
/// [D3D12: D3D12_GRAPHICS_PIPELINE_STATE_DESC]
struct GraphicsPipelineStateDesc {
  RootSignature pRootSignature = {};  ///< a global one that feeds every resource of all shaders
  GraphicsShader VS = {};             ///< the vertex shader
  /// The geometry shader, or empty. The primitive that it takes is of PrimitiveTopologyType. The
  /// last shader before the pixel shader writes SV_Position. [D3D11.3: 13]
  GraphicsShader GS = {};
  GraphicsShader PS = {};            ///< the pixel shader; without one only depth and stencil
  rtapi::BlendDesc BlendState = {};  ///< blending and write masks
  /// A bit for each sample, the lowest for sample 0: those that are drawn.
  uint32_t SampleMask = 0xFFFFFFFFu;
  rtapi::RasterizerDesc RasterizerState = {};      ///< culling, bias, clipping
  rtapi::DepthStencilDesc DepthStencilState = {};  ///< depth and stencil test
  std::vector<InputElementDesc> InputLayout = {};  ///< at most 32; spare ones are allowed
  IndexBufferStripCutValue IBStripCutValue = IndexBufferStripCutValue::kDisabled;  ///< for strips
  rtapi::PrimitiveTopologyType PrimitiveTopologyType =
      rtapi::PrimitiveTopologyType::kTriangle;  ///< what draws with it draw
  std::vector<Format> RTVFormats = {};          ///< at most 8; kUnknown: no target in that slot
  Format DSVFormat = Format::kUnknown;          ///< a depth format, or kUnknown
  rtapi::SampleDesc SampleDesc = {};            ///< that of every target which draws use
  std::string Name = {};                        ///< for messages; empty: the vertex shader's name
};

// ---------------------------------------------------------------------------------------------
// State that a list sets for draws

/// The place where normalized coordinates -1 to 1 come to lie, in pixels from the upper left corner
/// of the target, and depth. [D3D12: D3D12_VIEWPORT]
struct Viewport {
  /// The upper left corner, which need not be whole.
  ///@{
  float TopLeftX = 0;
  float TopLeftY = 0;
  ///@}
  float Width = 0;     ///< 0 or less: nothing is drawn
  float Height = 0;    ///< 0: nothing is drawn; negative: upside down
  float MinDepth = 0;  ///< of z/w = 0: 0 to 1
  float MaxDepth = 1;  ///< of z/w = 1: 0 to 1; may be the smaller one
};

/// Pixels [left, right) x [top, bottom). [D3D12: D3D12_RECT]
struct Rect {
  /// A border, in pixels.
  ///@{
  int32_t left = 0;
  int32_t top = 0;
  int32_t right = 0;
  int32_t bottom = 0;
  ///@}
};

/// Arguments of DrawInstanced, as ExecuteIndirect reads them. [D3D12: D3D12_DRAW_ARGUMENTS]
struct DrawArguments {
  uint32_t VertexCountPerInstance = 0;  ///< 0: nothing is drawn
  uint32_t InstanceCount = 0;           ///< 0: nothing is drawn
  uint32_t StartVertexLocation = 0;     ///< added to the vertex that is read, not to SV_VertexID
  uint32_t StartInstanceLocation = 0;   ///< added to the element that is read, not to SV_InstanceID
};

/// Arguments of DrawIndexedInstanced, as ExecuteIndirect reads them.
/// [D3D12: D3D12_DRAW_INDEXED_ARGUMENTS]
struct DrawIndexedArguments {
  uint32_t IndexCountPerInstance = 0;  ///< 0: nothing is drawn
  uint32_t InstanceCount = 0;          ///< 0: nothing is drawn
  uint32_t StartIndexLocation = 0;     ///< the first index that is read
  int32_t BaseVertexLocation = 0;      ///< added to the index, not to SV_VertexID
  uint32_t StartInstanceLocation = 0;  ///< added to the element that is read, not to SV_InstanceID
};

/// The parts that CommandList::ClearDepthStencilView clears. [D3D12: D3D12_CLEAR_FLAGS]
enum class ClearFlags : uint32_t { kDepth = 1, kStencil = 2 };
template <>
inline constexpr bool kIsFlags<ClearFlags> = true;

}  // namespace rtapi
