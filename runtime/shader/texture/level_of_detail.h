// SPDX-License-Identifier: MIT
//
// Bounds of a level of detail. [D3D11.3 7.18.10]
#pragma once

#include <algorithm>

#include "kaamos/shader/texture_view.h"

namespace kaamos::shader {

// Adds the sampler's bias and applies all lower and upper bounds except the view's last mip.
inline float clamped_lod(const TextureView& view, const SamplerState& sampler, float min_lod,
                         float lod) {
  // Comparisons with NaN are false, so NaN becomes the lower bound.
  const float low = std::max(std::max(sampler.min_lod, view.min_lod), min_lod);
  lod += sampler.mip_lod_bias;
  lod = lod > low ? lod : low;
  return lod < sampler.max_lod ? lod : sampler.max_lod;
}

}  // namespace kaamos::shader
