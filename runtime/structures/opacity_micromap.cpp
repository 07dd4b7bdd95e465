// SPDX-License-Identifier: MIT
#include "runtime/structures/opacity_micromap.h"

#include <algorithm>
#include <cmath>

namespace kaamos::runtime {
namespace {

// The low 16 bits, each moved to twice its place.
uint32_t spread(uint32_t bits) {
  bits = (bits | bits << 8) & 0x00FF00FFu;
  bits = (bits | bits << 4) & 0x0F0F0F0Fu;
  bits = (bits | bits << 2) & 0x33333333u;
  return (bits | bits << 1) & 0x55555555u;
}

}  // namespace

// The curve of DXR's figures: it enters a triangle at its first vertex, leaves it at its last one,
// and visits a quarter, the middle, and the two other quarters.
uint32_t micro_triangle_index(float u, float v, uint32_t level) {
  const uint32_t n = 1u << level;
  // NaN becomes 0.
  const float fu = (u > 0 ? std::min(u, 1.0f) : 0.0f) * static_cast<float>(n);
  const float fv = (v > 0 ? std::min(v, 1.0f) : 0.0f) * static_cast<float>(n);
  uint32_t iu = std::min(static_cast<uint32_t>(fu), n - 1);
  const uint32_t iv = std::min(static_cast<uint32_t>(fv), n - 1);
  const float within = (fu - std::floor(fu)) + (fv - std::floor(fv));
  const uint32_t sum = iu + iv;
  if (sum >= n) iu -= sum - n + 1;  // on or beyond the edge u + v = 1
  uint32_t iw = ~(iu + iv);
  if (within >= 1 && sum < n - 1) --iw;  // the cell's second triangle
  const uint32_t even = ~(iu ^ iw) & (n - 1);
  const uint32_t both = (iu ^ iv) & even;
  uint32_t flips = both;
  for (const uint32_t shift : {1u, 2u, 4u, 8u}) flips ^= flips >> shift;
  const uint32_t odd = (((flips ^ iu) & ~even) | both) & (n - 1);
  return spread(even) | spread(odd) << 1;
}

void MicromapArray::add(uint32_t level, MicromapFormat format, std::span<const uint8_t> bits) {
  micromaps_.push_back({bits_.size(), level, format});
  bits_.insert(bits_.end(), bits.begin(), bits.end());
}

MicromapState MicromapArray::state(uint32_t micromap, uint32_t micro_triangle) const {
  const Micromap& one = micromaps_[micromap];
  const uint8_t* bits = bits_.data() + one.offset;
  const uint32_t k = micro_triangle;
  if (one.format == MicromapFormat::kTwoStates) {
    return static_cast<MicromapState>(bits[k >> 3] >> (k & 7) & 1);
  }
  return static_cast<MicromapState>(bits[k >> 2] >> 2 * (k & 3) & 3);
}

}  // namespace kaamos::runtime
