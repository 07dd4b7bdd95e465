// SPDX-License-Identifier: MIT
/// @file
/// Enhanced barriers: what must be done before, what waits, and which accesses memory must be
/// visible to, each by itself. Names and numbers are those of D3D12. [D3D12: Enhanced Barriers]
#pragma once

#include <cstdint>

#include <rtapi/resource.h>
#include <rtapi/types.h>

namespace rtapi {

/// Work that a barrier waits for, or that waits for it. [D3D12: D3D12_BARRIER_SYNC]
enum class BarrierSync : uint32_t {
  kNone = 0,  ///< no work of the list; with kNoAccess only
  kAll = 0x1,
  kDraw = 0x2,
  kIndexInput = 0x4,
  kVertexShading = 0x8,
  kPixelShading = 0x10,
  kDepthStencil = 0x20,
  kRenderTarget = 0x40,
  kComputeShading = 0x80,
  kRaytracing = 0x100,
  kCopy = 0x200,
  kResolve = 0x400,
  kExecuteIndirect = 0x800,  ///< D3D12_BARRIER_SYNC_PREDICATION, too
  kAllShading = 0x1000,
  kNonPixelShading = 0x2000,
  kEmitPostbuildInfo = 0x4000,
  kClearUnorderedAccessView = 0x8000,
  kBuildAccelerationStructure = 0x800000,
  kCopyAccelerationStructure = 0x1000000,
  /// As SyncAfter: the first half of a split barrier, which takes place at the second, with this as
  /// SyncBefore. Alone; not in global barriers.
  kSplit = 0x80000000,
};
template <>
inline constexpr bool kIsFlags<BarrierSync> = true;

/// How memory is accessed. [D3D12: D3D12_BARRIER_ACCESS]
enum class BarrierAccess : uint32_t {
  kCommon = 0,  ///< every access that the layout allows
  kVertexBuffer = 0x1,
  kConstantBuffer = 0x2,
  kIndexBuffer = 0x4,
  kRenderTarget = 0x8,
  kUnorderedAccess = 0x10,
  kDepthStencilWrite = 0x20,
  kDepthStencilRead = 0x40,
  kShaderResource = 0x80,
  kStreamOutput = 0x100,
  kIndirectArgument = 0x200,  ///< D3D12_BARRIER_ACCESS_PREDICATION, too
  kCopyDest = 0x400,
  kCopySource = 0x800,
  kResolveDest = 0x1000,
  kResolveSource = 0x2000,
  kAccelerationStructureRead = 0x4000,
  kAccelerationStructureWrite = 0x8000,
  kNoAccess = 0x80000000,  ///< alone
};
template <>
inline constexpr bool kIsFlags<BarrierAccess> = true;

/// How a texture's subresource is laid out, which decides how it may be accessed. Kaamos has one
/// kind of queue, for which the layouts of a queue are; those of video and shading rates are
/// refused. [D3D12: D3D12_BARRIER_LAYOUT, Layout Access Compatibility]
enum class BarrierLayout : uint32_t {
  kCommon = 0,  ///< shader resource, copies; what is presented
  kGenericRead = 1,
  kRenderTarget = 2,
  kUnorderedAccess = 3,
  kDepthStencilWrite = 4,
  kDepthStencilRead = 5,
  kShaderResource = 6,
  kCopySource = 7,
  kCopyDest = 8,
  kResolveSource = 9,
  kResolveDest = 10,
  kDirectQueueCommon = 18,  ///< as kCommon, and unordered access
  kDirectQueueGenericRead = 19,
  kDirectQueueUnorderedAccess = 20,
  kDirectQueueShaderResource = 21,
  kDirectQueueCopySource = 22,
  kDirectQueueCopyDest = 23,
  kComputeQueueCommon = 24,
  kComputeQueueGenericRead = 25,
  kComputeQueueUnorderedAccess = 26,
  kComputeQueueShaderResource = 27,
  kComputeQueueCopySource = 28,
  kComputeQueueCopyDest = 29,
  kUndefined = 0xFFFFFFFF,  ///< as LayoutBefore: whatever it is, and its texels are lost
};

/// The state in which `layout` leaves a texture, as if a transition had: what a texture has that is
/// created with it. kUndefined is kCommon.
ResourceStates StatesOfLayout(BarrierLayout layout);

/// What every barrier says. Each access needs one of the kinds of work that make it.
/// [D3D12: D3D12_GLOBAL_BARRIER; Access Bits Barrier Sync Compatibility]
struct GlobalBarrier {
  BarrierSync SyncBefore = BarrierSync::kAll;           ///< is done first
  BarrierSync SyncAfter = BarrierSync::kAll;            ///< waits
  BarrierAccess AccessBefore = BarrierAccess::kCommon;  ///< what was done
  BarrierAccess AccessAfter = BarrierAccess::kCommon;   ///< what follows
};

/// A barrier for one buffer. [D3D12: D3D12_BUFFER_BARRIER]
struct BufferBarrier : GlobalBarrier {
  rtapi::Buffer Resource = {};  ///< whole
  uint64_t Offset = 0;          ///< 0
  uint64_t Size = UINT64_MAX;   ///< UINT64_MAX, or the bytes of the buffer
};

/// Subresources of a texture: mips by array elements by planes. [D3D12:
/// D3D12_BARRIER_SUBRESOURCE_RANGE]
struct BarrierSubresourceRange {
  uint32_t IndexOrFirstMipLevel = 0xFFFFFFFF;  ///< without NumMipLevels: one index, or ~0 for all
  uint32_t NumMipLevels = 0;                   ///< mips from the first; 0: an index
  uint32_t FirstArraySlice = 0;                ///< with NumMipLevels
  uint32_t NumArraySlices = 0;                 ///< with NumMipLevels; 0: one
  uint32_t FirstPlane = 0;                     ///< with NumMipLevels: 0 depth or all, 1 stencil
  uint32_t NumPlanes = 0;                      ///< with NumMipLevels; 0: all from the first on
};

/// [D3D12: D3D12_TEXTURE_BARRIER_FLAGS]
enum class TextureBarrierFlags : uint32_t {
  kNone = 0,
  kDiscard = 1,  ///< with kUndefined as LayoutBefore: the texels are not needed
};
template <>
inline constexpr bool kIsFlags<TextureBarrierFlags> = true;

/// A barrier for subresources of a texture, and a change of their layout.
/// [D3D12: D3D12_TEXTURE_BARRIER]
struct TextureBarrier : GlobalBarrier {
  BarrierLayout LayoutBefore = BarrierLayout::kCommon;     ///< the layout that they have
  BarrierLayout LayoutAfter = BarrierLayout::kCommon;      ///< the layout that they get
  rtapi::Texture Resource = {};                            ///< not empty
  BarrierSubresourceRange Subresources = {};               ///< all of them
  TextureBarrierFlags Flags = TextureBarrierFlags::kNone;  ///< kDiscard
};

}  // namespace rtapi
