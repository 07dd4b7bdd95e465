// SPDX-License-Identifier: MIT
//
// Reading and writing one element of a DXGI format as the four 32-bit values of a Texel.
// [D3D11.3 3.2.3 data conversion; DXGI_FORMAT]
#pragma once

#include <array>
#include <cstdint>

#include "kaamos/shader/abi.h"

namespace kaamos::shader {

// What the 32-bit values of a texel are.
enum class NumberClass : uint8_t { kFloat, kUint, kSint };

struct FormatCodec {
  uint8_t bytes = 0;     // of one element; 0: the format is not supported
  uint8_t channels = 0;  // bit i: channel i is stored; others read 0, alpha 1
  NumberClass number = NumberClass::kFloat;
  bool normalized = false;  // unorm or snorm
  Texel (*decode)(const uint8_t* element) = nullptr;
  // Clamps to the format's range; NaN becomes 0 in normalized formats. Null: cannot be written
  // (sRGB and shared-exponent formats, as in D3D).
  void (*encode)(uint8_t* element, const Texel& value) = nullptr;
};

// Never fails: an unknown, typeless, depth or block-compressed format has bytes 0 and no functions.
const FormatCodec& format_codec(uint32_t dxgi_format);

// sRGB to linear for every byte: the formula's value rounded to float. [D3D11.3 3.2.3.7]
extern const std::array<float, 256> kSrgbToLinear;
inline float srgb_to_linear(uint8_t value) {
  return kSrgbToLinear[value];
}
// Linear to sRGB, rounded to nearest; NaN gives 0.
uint8_t linear_to_srgb(float value);

// The channels that a format lacks: 0, and 1 for alpha.
constexpr uint32_t missing_channel(NumberClass number, int channel) {
  if (channel != 3) return 0;
  return number == NumberClass::kFloat ? 0x3F800000u : 1u;
}

}  // namespace kaamos::shader
