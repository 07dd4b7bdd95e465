// SPDX-License-Identifier: MIT
#include "effects/assets/image/tonemap.h"

#include <algorithm>
#include <cmath>

#include "effects/assets/image/srgb.h"

namespace kaamos::effects {
namespace {

std::uint8_t to_byte(float unit) {
  // The comparison is false for NaN.
  if (!(unit > 0.0f)) return 0;
  return static_cast<std::uint8_t>(std::min(unit, 1.0f) * 255.0f + 0.5f);
}

template <class Curve>
ByteImage convert(const FloatImage& from, Curve curve) {
  ByteImage to;
  to.width = from.width;
  to.height = from.height;
  to.channels = from.channels >= 3 ? 3 : 1;
  const std::size_t pixels = std::size_t{from.width} * from.height;
  to.values.resize(pixels * to.channels);
  for (std::size_t p = 0; p < pixels; ++p)
    for (std::uint32_t c = 0; c < to.channels; ++c)
      to.values[p * to.channels + c] = to_byte(curve(from.values[p * from.channels + c]));
  return to;
}

}  // namespace

float filmic(float x) {
  if (!(x > 0.0f)) return 0.0f;
  x = std::min(x, 1e4f);
  return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

ByteImage tonemap(const FloatImage& radiance, float exposure) {
  return convert(radiance, [=](float v) { return srgb_from_linear(filmic(v * exposure)); });
}

ByteImage to_bytes(const FloatImage& image, float scale, float bias, bool srgb) {
  return convert(image, [=](float v) {
    const float unit = v * scale + bias;
    return srgb ? srgb_from_linear(std::clamp(unit, 0.0f, 1.0f)) : unit;
  });
}

}  // namespace kaamos::effects
