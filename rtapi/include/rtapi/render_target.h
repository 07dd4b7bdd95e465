// SPDX-License-Identifier: MIT
/// @file
/// Views of textures that draws write to.
#pragma once

#include <cstdint>

#include <rtapi/format.h>
#include <rtapi/types.h>

namespace rtapi {

/// The kind of resource that a render target view looks at. [D3D12: D3D12_RTV_DIMENSION]
enum class RtvDimension : uint32_t {
  kUnknown = 0,
  kTexture1D = 2,
  kTexture1DArray = 3,
  kTexture2D = 4,
  kTexture2DArray = 5,
  kTexture2DMS = 6,
  kTexture2DMSArray = 7,
  kTexture3D = 8,
};
/// The kind of resource that a depth-stencil view looks at. [D3D12: D3D12_DSV_DIMENSION]
enum class DsvDimension : uint32_t {
  kUnknown = 0,
  kTexture2D = 3,
  kTexture2DArray = 4,
  kTexture2DMS = 5,
  kTexture2DMSArray = 6,
};

/// The parts of a depth-stencil view that draws leave alone, so that shaders may read them at the
/// same time. [D3D12: D3D12_DSV_FLAGS]
enum class DsvFlags : uint32_t { kNone = 0, kReadOnlyDepth = 1, kReadOnlyStencil = 2 };
template <>
inline constexpr bool kIsFlags<DsvFlags> = true;

/// One mip level of some elements of a 1-D or 2-D texture, or of some slices of a 3-D texture's
/// depth; cube faces are elements +X, -X, +Y, -Y, +Z, -Z. Multisampled textures have mip 0 alone.
/// [D3D12: D3D12_TEX2D_ARRAY_RTV, D3D12_TEX2D_ARRAY_DSV, D3D12_TEX2DMS_ARRAY_RTV, D3D12_TEX3D_RTV]
struct TargetSlices {
  uint32_t MipSlice = 0;             ///< the level
  uint32_t FirstArraySlice = 0;      ///< the element that SV_RenderTargetArrayIndex knows as 0
  uint32_t ArraySize = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the array or depth
};

/// Describes a view for Device::CreateRenderTargetView. [D3D12: D3D12_RENDER_TARGET_VIEW_DESC]
struct RenderTargetViewDesc {
  /// The texture's own format, which kUnknown stands for, or a typed format of its family.
  rtapi::Format Format = rtapi::Format::kUnknown;
  /// That of the texture. kTexture1D, kTexture2D and kTexture2DMS use one element, FirstArraySlice
  /// 0; kUnknown: the whole of mip 0. Those with MS are for textures of more than one sample.
  RtvDimension ViewDimension = RtvDimension::kUnknown;
  /// For every dimension: those of one element use MipSlice alone, kTexture3D slices of the depth.
  TargetSlices Texture2DArray = {};
};

/// Describes a view for Device::CreateDepthStencilView. [D3D12: D3D12_DEPTH_STENCIL_VIEW_DESC]
struct DepthStencilViewDesc {
  /// A depth format: the texture's own, which kUnknown stands for, or that of its typeless family.
  rtapi::Format Format = rtapi::Format::kUnknown;
  /// kTexture2D and kTexture2DMS use one element, FirstArraySlice 0; kUnknown: the whole of mip 0.
  /// Those with MS are for textures of more than one sample.
  DsvDimension ViewDimension = DsvDimension::kUnknown;
  DsvFlags Flags = DsvFlags::kNone;  ///< what draws leave alone
  TargetSlices Texture2DArray = {};  ///< kTexture2D: only MipSlice counts; also of the MS ones
};

/// A value that draws usually clear a texture to: a hint without effect, as in D3D12.
/// [D3D12: D3D12_CLEAR_VALUE]
struct ClearValue {
  rtapi::Format Format = rtapi::Format::kUnknown;  ///< of the view that is cleared
  float Color[4] = {0, 0, 0, 0};                   ///< render targets
  float Depth = 0;                                 ///< depth formats
  uint8_t Stencil = 0;                             ///< depth formats
};

}  // namespace rtapi
