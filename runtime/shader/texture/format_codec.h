// SPDX-License-Identifier: MIT
//
// Reads and writes one element of a DXGI format as the four 32-bit values of a Texel. [D3D11.3
// 3.2.3 data conversion; DXGI_FORMAT]
#pragma once

#include <array>
#include <cstdint>

#include "kaamos/shader/abi.h"

namespace kaamos::shader {

// The type of the 32-bit values of a texel.
enum class NumberClass : uint8_t { kFloat, kUint, kSint };

struct FormatCodec {
  uint8_t bytes = 0;     // size of one element; 0: the format is not supported
  uint8_t channels = 0;  // bit i: channel i is stored; other channels read 0, alpha 1
  NumberClass number = NumberClass::kFloat;
  bool normalized = false;  // unorm or snorm
  Texel (*decode)(const uint8_t* element) = nullptr;
  // Clamps to the format's range; NaN becomes 0 in normalized formats. Null if the format cannot be
  // written (sRGB and shared-exponent formats, as in D3D).
  void (*encode)(uint8_t* element, const Texel& value) = nullptr;
};

// Never fails: unknown, typeless, depth-stencil and block-compressed formats have 0 bytes and no
// functions.
const FormatCodec& format_codec(uint32_t dxgi_format);

// sRGB to linear for every byte: the value of the formula, rounded to float. [D3D11.3 3.2.3.7]
extern const std::array<float, 256> kSrgbToLinear;
inline float srgb_to_linear(uint8_t value) {
  return kSrgbToLinear[value];
}
// Linear to sRGB, rounded to nearest; NaN gives 0.
uint8_t linear_to_srgb(float value);

// The value of a channel that the format lacks: 0, or 1 for alpha.
constexpr uint32_t missing_channel(NumberClass number, int channel) {
  if (channel != 3) return 0;
  return number == NumberClass::kFloat ? 0x3F800000u : 1u;
}

}  // namespace kaamos::shader
