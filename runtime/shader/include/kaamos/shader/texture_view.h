// SPDX-License-Identifier: MIT
//
// The data that the address in a texture's or sampler's descriptor points to for native shader
// code. It is part of the interface so that plain loads and stores need no call. Plain data: the
// backend owns it and the texels.
#pragma once

#include <cstdint>

#include "kaamos/shader/abi.h"

namespace kaamos::shader {

// The values of D3D12_SRV_DIMENSION; unordered access views use the same where they exist.
enum class TextureDimension : uint32_t {
  k1D = 2,
  k1DArray = 3,
  k2D = 4,
  k2DArray = 5,
  k3D = 8,
  kCube = 9,
  kCubeArray = 10,
};

// 16384 texels, the largest side of a D3D12 texture, give 15 mips.
inline constexpr uint32_t kMaxTextureMips = 15;

struct TextureMip {
  uint8_t* texels = nullptr;  // texel (0, 0, 0) of the view's first slice
  uint32_t width = 0;
  uint32_t height = 0;       // 1 for 1-D textures
  uint32_t depth = 0;        // 3-D: slices of the view; else 1
  uint32_t row_pitch = 0;    // bytes from a row to the next
  uint64_t slice_pitch = 0;  // bytes from an array element, cube face or depth slice to the next
};

struct TextureView {
  uint32_t format = 0;  // DXGI_FORMAT; formats that format_codec() does not know read as zeros
  TextureDimension dimension = TextureDimension::k2D;
  bool unordered_access = false;  // only these can be written
  // D3D12_SHADER_COMPONENT_MAPPING per channel: 0..3 channel, 4 zero, 5 one. For reads and samples.
  uint8_t swizzle[4] = {0, 1, 2, 3};
  uint32_t mip_count = 0;    // of the view; at most kMaxTextureMips
  uint32_t slice_count = 1;  // array elements of the view; cube faces, a multiple of 6
  float min_lod = 0;         // ResourceMinLODClamp, counted from the view's first mip
  // `format` if texels of mip 0 may be read (and written, if unordered_access) in memory as they
  // are: 2-D, channels in order, texels not null. Otherwise 0.
  uint32_t direct_format = 0;
  TextureMip mips[kMaxTextureMips];
};

// The members, order and values of D3D12_SAMPLER_DESC.
struct SamplerState {
  uint32_t filter = 0x15;  // anisotropic filters count as linear ones
  uint32_t address[3] = {1, 1, 1};
  float mip_lod_bias = 0;
  uint32_t max_anisotropy = 1;
  uint32_t comparison = 1;
  float border_color[4] = {0, 0, 0, 0};
  float min_lod = 0;
  float max_lod = 3.402823466e+38f;
};

// Null if it is not a texture's descriptor, or the view has no texels.
inline const TextureView* texture_view(const Descriptor& descriptor) {
  if (descriptor.kind != DescriptorKind::kTexture) return nullptr;
  const auto* view = reinterpret_cast<const TextureView*>(descriptor.address);
  return view != nullptr && view->mip_count != 0 ? view : nullptr;
}
inline const SamplerState* sampler_state(const Descriptor& descriptor) {
  if (descriptor.kind != DescriptorKind::kSampler) return nullptr;
  return reinterpret_cast<const SamplerState*>(descriptor.address);
}

}  // namespace kaamos::shader
