// SPDX-License-Identifier: MIT
#include "runtime/raster/resolve.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "runtime/raster/target_codec.h"

namespace kaamos::raster {
namespace {

using rtapi::FormatClass;
using rtapi::ResolveMode;

constexpr uint32_t kLanes = shader::kGraphicsLanes;

// Depth is read as shaders read it.
rtapi::Format resolved_format(rtapi::Format format) {
  switch (format) {
    case rtapi::Format::kD16Unorm:
      return rtapi::Format::kR16Unorm;
    case rtapi::Format::kD32Float:
      return rtapi::Format::kR32Float;
    default:
      return format;
  }
}

template <bool kLoads>
void move(const TargetCodec& codec, uint8_t* texels, uint32_t count, shader::Column* words) {
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t texel[4] = {};
    if constexpr (kLoads) {
      std::memcpy(texel, texels + size_t{i} * codec.bytes, codec.bytes);
      for (uint32_t w = 0; w < codec.words; ++w) words[w][i] = texel[w];
    } else {
      for (uint32_t w = 0; w < codec.words; ++w) texel[w] = words[w][i];
      std::memcpy(texels + size_t{i} * codec.bytes, texel, codec.bytes);
    }
  }
}

template <class T>
uint32_t extreme(uint32_t a, uint32_t b, bool greatest) {
  const T x = std::bit_cast<T>(a);
  const T y = std::bit_cast<T>(b);
  return std::bit_cast<uint32_t>(greatest ? std::max(x, y) : std::min(x, y));
}

uint32_t joined(uint32_t a, uint32_t b, FormatClass type, ResolveMode mode) {
  if (mode == ResolveMode::kAverage) {
    return std::bit_cast<uint32_t>(std::bit_cast<float>(a) + std::bit_cast<float>(b));
  }
  const bool greatest = mode == ResolveMode::kMax;
  switch (type) {
    case FormatClass::kUint:
      return extreme<uint32_t>(a, b, greatest);
    case FormatClass::kSint:
      return extreme<int32_t>(a, b, greatest);
    default:
      return extreme<float>(a, b, greatest);
  }
}

}  // namespace

void resolve(const Surface& dest, const Surface& source, ResolveMode mode) {
  const rtapi::Format format = resolved_format(dest.format);
  const TargetCodec& codec = target_codec(format);
  const FormatClass type = rtapi::GetFormatInfo(format).type;
  for (uint32_t y = 0; y < dest.height; ++y) {
    for (uint32_t x = 0; x < dest.width; x += kLanes) {
      const uint32_t count = std::min(kLanes, dest.width - x);
      shader::Column words[4] = {};
      shader::Column sum[4] = {};
      for (uint32_t s = 0; s < source.samples; ++s) {
        move<true>(codec,
                   source.texels + s * source.sample_pitch + y * source.row_pitch +
                       uint64_t{x} * codec.bytes,
                   count, words);
        shader::Column colors[4];
        codec.decode(words, colors);
        for (uint32_t c = 0; c < 4; ++c) {
          for (uint32_t i = 0; i < kLanes; ++i) {
            sum[c][i] = s == 0 ? colors[c][i] : joined(sum[c][i], colors[c][i], type, mode);
          }
        }
      }
      if (mode == ResolveMode::kAverage) {
        const float scale = 1.0f / static_cast<float>(source.samples);
        for (auto& column : sum) {
          for (uint32_t& value : column) {
            value = std::bit_cast<uint32_t>(std::bit_cast<float>(value) * scale);
          }
        }
      }
      codec.encode(sum, words);
      move<false>(codec, dest.texels + y * dest.row_pitch + uint64_t{x} * codec.bytes, count,
                  words);
    }
  }
}

}  // namespace kaamos::raster
