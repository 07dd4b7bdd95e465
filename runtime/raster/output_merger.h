// SPDX-License-Identifier: MIT
//
// Writes the colours of two quads to the render targets. [D3D11.3: 17]
#pragma once

#include <algorithm>
#include <bit>

#include "runtime/raster/blend.h"
#include "runtime/raster/draw_plan.h"
#include "runtime/raster/lanes.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

// The first pixel of each quad, in the targets.
struct QuadPlaces {
  uint32_t x[2];
  uint32_t y[2];
  uint32_t slice;
};

// Calls f(texel, lane) for the pixels of `live`.
template <class F>
KAAMOS_INLINE void each_target_texel(const PlannedTarget& target, const QuadPlaces& places,
                                     uint32_t live, const F& f) {
  const Surface& surface = *target.surface;
  const uint32_t bytes = target.codec->bytes;
  for (uint32_t rest = live; rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<uint32_t>(std::countr_zero(rest));
    const uint32_t quad = lane / 4;
    const uint64_t x = places.x[quad] + (lane & 1);
    const uint64_t y = places.y[quad] + (lane >> 1 & 1);
    f(surface.texels + places.slice * surface.slice_pitch + y * surface.row_pitch + x * bytes,
      lane);
  }
}

template <uint32_t kBytes>
inline void read_texels(const PlannedTarget& target, const QuadPlaces& places, uint32_t live,
                        shader::Column* words) {
  each_target_texel(target, places, live, [&](const uint8_t* texel, uint32_t lane) {
    constexpr uint32_t kWords = (kBytes + 3) / 4;
    uint32_t values[kWords] = {};
    __builtin_memcpy(values, texel, kBytes);
    for (uint32_t w = 0; w < kWords; ++w) words[w][lane] = values[w];
  });
}
template <uint32_t kBytes>
inline void write_texels(const PlannedTarget& target, const QuadPlaces& places, uint32_t live,
                         const shader::Column* words) {
  each_target_texel(target, places, live, [&](uint8_t* texel, uint32_t lane) {
    constexpr uint32_t kWords = (kBytes + 3) / 4;
    uint32_t values[kWords];
    for (uint32_t w = 0; w < kWords; ++w) values[w] = words[w][lane];
    __builtin_memcpy(texel, values, kBytes);
  });
}

// Calls f with the number of bytes of a texel as a constant.
template <class F>
KAAMOS_INLINE void with_bytes(uint32_t bytes, const F& f) {
  switch (bytes) {
    case 1:
      return f(std::integral_constant<uint32_t, 1>());
    case 2:
      return f(std::integral_constant<uint32_t, 2>());
    case 4:
      return f(std::integral_constant<uint32_t, 4>());
    case 8:
      return f(std::integral_constant<uint32_t, 8>());
    default:
      return f(std::integral_constant<uint32_t, 16>());
  }
}

inline void write_target(const DrawPlan& plan, const PlannedTarget& target,
                         const QuadPlaces& places, const shader::Column* outputs, uint32_t live) {
  const TargetCodec& codec = *target.codec;
  alignas(32) shader::Column components[4];
  const shader::Column* colors = outputs + target.first_column;
  if (target.components < 4) {
    __builtin_memset(components, 0, sizeof(components));
    __builtin_memcpy(components, colors, target.components * sizeof(shader::Column));
    colors = components;
  }
  alignas(32) shader::Column words[4];
  if (target.whole_texels && !target.blends) {
    codec.encode(colors, words);
  } else {
    alignas(32) shader::Column old[4] = {};
    with_bytes(codec.bytes, [&](auto bytes) { read_texels<bytes>(target, places, live, old); });
    alignas(32) shader::Column blended[4];
    if (target.blends) {
      alignas(32) shader::Column destination[4];
      codec.decode(old, destination);
      blend_colors(target.blend, codec, plan.blend_factor, colors, destination, blended);
      colors = blended;
    }
    codec.encode(colors, words);
    for (uint32_t w = 0; w < codec.words; ++w) {
      for (int i = 0; i < shader::kGraphicsLanes; ++i) {
        words[w][i] = (words[w][i] & target.mask[w]) | (old[w][i] & ~target.mask[w]);
      }
    }
  }
  with_bytes(codec.bytes, [&](auto bytes) { write_texels<bytes>(target, places, live, words); });
}

// `outputs`: the pixel shader's columns.
inline void write_targets(const DrawPlan& plan, const QuadPlaces& places,
                          const shader::Column* outputs, uint32_t live) {
  for (const PlannedTarget& target : plan.targets) {
    write_target(plan, target, places, outputs, live);
  }
}

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
