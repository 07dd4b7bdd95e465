// SPDX-License-Identifier: MIT
//
// Colours of render targets: how eight pixels become texels. [D3D11.3: 3.2]
#pragma once

#include <cstdint>

#include <kaamos/shader/graphics.h>
#include <rtapi/format.h>

namespace kaamos::raster {

// The way in which fast_encode.h writes a format.
enum class FastEncode : uint8_t { kNone, kWords, kHalves, kRgba8, kRgba8Srgb, kBgra8, kBgra8Srgb };

// A texel is up to four words; those of fewer than 32 bits are in the low bits of one. Word w of
// pixel i is words[w][i].
struct TargetCodec {
  uint8_t bytes = 0;  // of a texel: 1, 2, 4, 8 or 16; 0: the format cannot be drawn to
  uint8_t words = 0;
  FastEncode fast = FastEncode::kNone;
  uint8_t columns = 4;   // of colours that encoding reads
  bool integer = false;  // does not blend
  // Blending clamps to 0 to 1, to -1 to 1 (clamped_signed), or not at all.
  bool clamped = false;
  bool clamped_signed = false;
  uint32_t component[4][4] = {};  // bits of each component in each word
  // From four columns of floats or integers: NaN is 0 in normalized formats, numbers out of range
  // are clamped, and floats of fewer bits are rounded toward zero.
  void (*encode)(const shader::Column* colors, shader::Column* words) = nullptr;
  // Back to four columns of floats.
  void (*decode)(const shader::Column* words, shader::Column* colors) = nullptr;
};

const TargetCodec& target_codec(rtapi::Format format);

}  // namespace kaamos::raster
