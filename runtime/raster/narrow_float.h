// SPDX-License-Identifier: MIT
//
// Floats of 16 and fewer bits as render targets store them. [D3D11.3: 3.2.2]
#pragma once

#include <bit>
#include <cstdint>

namespace kaamos::raster {

// The bits of a float as a half: rounded toward zero, what is too large becomes the largest finite
// number; infinities and NaN stay what they are.
constexpr uint32_t half_toward_zero(uint32_t bits) {
  const uint32_t sign = bits >> 16 & 0x8000u;
  const uint32_t magnitude = bits & 0x7FFFFFFFu;
  if (magnitude >= 0x7F800000u) {
    const bool nan = magnitude > 0x7F800000u;
    return sign | 0x7C00u | (nan ? 0x200u | (magnitude >> 13 & 0x3FFu) : 0u);
  }
  if (magnitude >= 0x477FE000u) return sign | 0x7BFFu;
  if (magnitude < 0x38800000u) {  // a multiple of 2^-24
    return sign | static_cast<uint32_t>(std::bit_cast<float>(magnitude) * 0x1p24f);
  }
  return sign | (magnitude - 0x38000000u) >> 13;
}

// Without a sign: negative numbers give 0. The formats of 11 and 10 bits are its upper bits.
constexpr uint32_t positive_half_toward_zero(uint32_t bits) {
  const uint32_t half = half_toward_zero(bits);
  const bool nan = (half & 0x7FFFu) > 0x7C00u;
  return (half & 0x8000u) != 0 && !nan ? 0 : half & 0x7FFFu;
}

}  // namespace kaamos::raster
