// SPDX-License-Identifier: MIT
//
// Loads and stores of single texels and typed buffer elements, with the signatures of Services.
// Reads out of bounds, through null descriptors and of unknown formats give zeros; such writes are
// dropped. [D3D11.3 7.18]
#pragma once

#include <cstdint>

#include "kaamos/shader/abi.h"
#include "kaamos/shader/texture_view.h"
#include "runtime/shader/texture/format_codec.h"

namespace kaamos::shader {

// coordinates: x, y, z or array element (cube: face), mip level of the view.
Texel load_texel(const Descriptor& texture, const int32_t coordinates[4]);
void store_texel(const Descriptor& texture, const int32_t coordinates[4], const Texel& value);
// Only unordered access views of R32 formats have addresses; others give null.
void* texel_address(const Descriptor& texture, const int32_t coordinates[4], uint32_t bytes);

Texel load_typed(const Descriptor& buffer, uint32_t element);
void store_typed(const Descriptor& buffer, uint32_t element, const Texel& value);
void* typed_address(const Descriptor& buffer, uint32_t element, uint32_t bytes);

// Textures: the size of that mip, zero past the last one; array elements count whole cubes. Typed
// buffers: width is the number of elements.
TextureDimensions texture_dimensions(const Descriptor& descriptor, uint32_t mip);

// ---------------------------------------------------------------------------------------------
// Used by the sampler, too.

// Null if out of range.
inline uint8_t* texel_pointer(const TextureView& view, uint32_t bytes, uint32_t x, uint32_t y,
                              uint32_t slice, uint32_t mip) {
  if (mip >= view.mip_count) return nullptr;
  const TextureMip& m = view.mips[mip];
  const uint32_t slices = view.dimension == TextureDimension::k3D ? m.depth : view.slice_count;
  if (x >= m.width || y >= m.height || slice >= slices || m.texels == nullptr) return nullptr;
  return m.texels + slice * m.slice_pitch + static_cast<uint64_t>(y) * m.row_pitch +
         static_cast<uint64_t>(x) * bytes;
}

// Applies the view's component mapping.
inline Texel swizzled(const TextureView& view, NumberClass number, const Texel& texel) {
  const uint8_t* s = view.swizzle;
  if (s[0] == 0 && s[1] == 1 && s[2] == 2 && s[3] == 3) return texel;
  Texel result;
  for (int i = 0; i < 4; ++i) {
    result.bits[i] = s[i] < 4 ? texel.bits[s[i]] : s[i] == 5 ? missing_channel(number, 3) : 0;
  }
  return result;
}

}  // namespace kaamos::shader
