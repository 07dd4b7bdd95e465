// SPDX-License-Identifier: MIT
//
// Vertices on their way from clip space to the screen: the viewport, snapping, and which borders
// of what can be seen they are beyond.
#pragma once

#include <bit>
#include <cstdint>

#include "runtime/raster/triangle.h"
#include "runtime/raster/viewport.h"

namespace kaamos::raster {

// The limits that a vertex is beyond, a bit each. Triangles whose vertices share one of the bits
// kOutside are not seen.
enum Outcode : uint32_t {
  kOutNear = 1,
  kOutFar = 2,
  kOutBehind = 4,  // w is not positive
  kOutLeft = 8,
  kOutRight = 16,
  kOutBottom = 32,
  kOutTop = 64,
  kOutGuard = 128,      // or not a number on the screen
  kNotFinite = 256,     // or a clip distance that is not a number
  kOutClip = 1u << 16,  // of clip distance 0; the next bits are those of the others
  kOutCull = 1u << 24,  // of cull distance 0
  kOutside = ~(kOutGuard | kNotFinite),
  kNeedsClip = kOutNear | kOutFar | kOutBehind | kOutGuard | 0xFFu << 16,
};

// A coordinate in subpixels, rounded to nearest even. NaN gives 0, and what is beyond the guard
// band its border. [D3D11.3: 3.2.4.1, 3.4.1]
template <class Number>
inline int32_t snap(Number pixels) {
  constexpr auto kLow = static_cast<Number>(kGuardLow * kSubpixels);
  constexpr auto kHigh = static_cast<Number>(kGuardHigh * kSubpixels);
  // Sums with it have no bits below 1.
  constexpr auto kWhole = static_cast<Number>(sizeof(Number) == 4 ? 0x1p23 : 0x1p52);
  Number value = pixels * kSubpixels;
  value = value == value ? value : Number{0};
  value = value > kLow ? value : kLow;
  value = value < kHigh ? value : kHigh;
  const Number magnitude = value < 0 ? -value : value;
  const auto rounded = static_cast<int32_t>((magnitude + kWhole) - kWhole);
  return value < 0 ? -rounded : rounded;
}

// N vertices by coordinate.
template <int N>
struct ClipVertices {
  float x[N], y[N], z[N], w[N];
};
template <int N>
struct ScreenVertices {
  int32_t x[N], y[N];
  float z[N], inv_w[N];
  uint32_t outcode[N];
};

// The outcode bits that do not depend on the viewport.
template <int N>
inline void clip_outcodes(const ClipVertices<N>& in, bool depth_clip, uint32_t* outcode) {
  for (int i = 0; i < N; ++i) {
    const float x = in.x[i], y = in.y[i], z = in.z[i], w = in.w[i];
    uint32_t code = 0;
    code |= x < -w ? kOutLeft : 0u;
    code |= x > w ? kOutRight : 0u;
    code |= y < -w ? kOutBottom : 0u;
    code |= y > w ? kOutTop : 0u;
    code |= w < kLeastW ? kOutBehind : 0u;
    const uint32_t depth = (z < 0.0f ? kOutNear : 0u) | (z > w ? kOutFar : 0u);
    code |= depth_clip ? depth : 0u;
    // The exponent of an infinity or NaN has all bits set.
    constexpr uint32_t kExponent = 0x7F800000u;
    const auto odd = [](float f) {
      return (std::bit_cast<uint32_t>(f) & kExponent) == kExponent ? kNotFinite + 0u : 0u;
    };
    outcode[i] = code | odd(x) | odd(y) | odd(z) | odd(w);
  }
}

// Adds kOutGuard to the outcodes.
template <int N>
inline void to_screen(const ClipVertices<N>& in, const ViewportState& viewport,
                      ScreenVertices<N>& out) {
  for (int i = 0; i < N; ++i) {
    const float w = in.w[i];
    const float x = in.x[i] / w * viewport.scale_x + viewport.offset_x;
    const float y = in.y[i] / w * viewport.scale_y + viewport.offset_y;
    const float z = in.z[i] / w * viewport.scale_z + viewport.offset_z;
    const bool inside = (x >= kGuardLow) & (x <= kGuardHigh) & (y >= kGuardLow) & (y <= kGuardHigh);
    out.outcode[i] |= inside ? 0u : kOutGuard;
    out.x[i] = snap(x);
    out.y[i] = snap(y);
    // Without depth clip z/w may overflow.
    constexpr float kLargest = 0x1.fffffep127f;
    const float above = z > -kLargest ? z : -kLargest;
    out.z[i] = above < kLargest ? above : kLargest;
    out.inv_w[i] = 1.0f / w;
  }
}

}  // namespace kaamos::raster
