// SPDX-License-Identifier: MIT
//
// Address modes: from a texture coordinate to texel indices. [D3D11.3 7.18.6 to 7.18.9]
#pragma once

#include <cmath>
#include <cstdint>

namespace kaamos::shader {

// The values of D3D12_TEXTURE_ADDRESS_MODE; any other value counts as wrap.
enum class AddressMode : uint32_t {
  kWrap = 1,
  kMirror = 2,
  kClamp = 3,
  kBorder = 4,
  kMirrorOnce = 5
};

// Used as a texel index, it means the border colour.
inline constexpr int32_t kBorderTexel = -1;

// size must be at least 1 and at most 2^30, i between -2^30 and 2^30.
inline int32_t addressed_texel(AddressMode mode, int32_t i, int32_t size) {
  switch (mode) {
    case AddressMode::kMirror: {
      const int32_t period = 2 * size;
      const int32_t m = (i % period + period) % period;
      return m < size ? m : period - 1 - m;
    }
    case AddressMode::kClamp:
      return i < 0 ? 0 : i < size ? i : size - 1;
    case AddressMode::kBorder:
      return i < 0 || i >= size ? kBorderTexel : i;
    case AddressMode::kMirrorOnce: {
      const int32_t m = i < 0 ? -1 - i : i;
      return m < size ? m : size - 1;
    }
    default:
      if (i >= 0 && i < size) return i;
      return (i % size + size) % size;
  }
}

// On x86-64 without SSE 4.1 std::floor is a call, which takes a sixth of a bilinear sample's time.
inline float fast_floor(float x) {
  if (!(std::fabs(x) < 0x1p23f)) return x;  // already whole, or NaN
  const float truncated = static_cast<float>(static_cast<int32_t>(x));
  return truncated > x ? truncated - 1.0f : truncated;
}

// A coordinate in units of the texture's size, brought close to [0, 1] if the mode repeats, so that
// large coordinates keep their fraction. NaN and whatever cannot be reduced become 0. [D3D11.3: NaN
// is 0]
inline float reduced_coordinate(AddressMode mode, float u) {
  if (mode == AddressMode::kMirror) {
    u -= 2.0f * fast_floor(u * 0.5f);
  } else if (mode != AddressMode::kClamp && mode != AddressMode::kBorder &&
             mode != AddressMode::kMirrorOnce) {
    u -= fast_floor(u);
  }
  return u == u ? u : 0.0f;
}

// Clamps to far outside of every texture but far from overflow: nothing that an application passes
// may trap.
inline int32_t offset_index(float x, int32_t offset) {
  constexpr int32_t kFar = 1 << 28;
  const int32_t i = x >= 0x1p28f ? kFar : x <= -0x1p28f ? -kFar : static_cast<int32_t>(x);
  return i + (offset > kFar ? kFar : offset < -kFar ? -kFar : offset);
}

// The two texels that linear filtering blends along one axis, and the second one's weight.
struct LinearTaps {
  int32_t first;
  int32_t second;
  float weight;
};

inline LinearTaps linear_taps(AddressMode mode, float u, int32_t size, int32_t offset) {
  const float x = reduced_coordinate(mode, u) * static_cast<float>(size) - 0.5f;
  const float whole = fast_floor(x);
  const float weight = x - whole;
  const int32_t i = offset_index(whole, offset);
  return {addressed_texel(mode, i, size), addressed_texel(mode, i + 1, size),
          weight == weight ? weight : 0.0f};  // an infinite coordinate has no fraction
}

inline int32_t point_tap(AddressMode mode, float u, int32_t size, int32_t offset) {
  const float x = fast_floor(reduced_coordinate(mode, u) * static_cast<float>(size));
  return addressed_texel(mode, offset_index(x, offset), size);
}

}  // namespace kaamos::shader
