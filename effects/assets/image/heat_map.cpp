// SPDX-License-Identifier: MIT
#include "effects/assets/image/heat_map.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kaamos::effects {
namespace {

// Brightness increases along the scale, so that the picture also reads without colours.
constexpr float kColors[5][3] = {
    {0, 0, 0}, {30, 40, 160}, {210, 40, 70}, {250, 200, 60}, {255, 255, 255}};

}  // namespace

void put_heat(float heat, std::uint8_t* out) {
  const float at = std::clamp(heat, 0.0f, 1.0f) * 4;
  const int first = std::min(static_cast<int>(at), 3);
  const float share = at - static_cast<float>(first);
  for (int c = 0; c < 3; ++c) {
    const float value = kColors[first][c] + share * (kColors[first + 1][c] - kColors[first][c]);
    out[c] = static_cast<std::uint8_t>(value + 0.5f);
  }
}

HeatMap heat_map(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> counts) {
  HeatMap out;
  const std::size_t pixels = std::size_t{width} * height;
  std::vector<std::uint32_t> sorted(
      counts.begin(),
      counts.begin() + static_cast<std::ptrdiff_t>(std::min(pixels, counts.size())));
  sorted.resize(pixels);
  double sum = 0;
  for (const std::uint32_t count : sorted) sum += count;
  out.mean = pixels == 0 ? 0 : sum / static_cast<double>(pixels);
  std::sort(sorted.begin(), sorted.end());
  if (pixels != 0) {
    out.most = sorted.back();
    out.white = std::max(1u, sorted[pixels - 1 - pixels / 1000]);
  }
  out.image.width = width;
  out.image.height = height;
  out.image.channels = 3;
  out.image.values.resize(pixels * 3);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint32_t count = i < counts.size() ? counts[i] : 0;
    put_heat(static_cast<float>(count) / static_cast<float>(out.white), &out.image.values[i * 3]);
  }
  return out;
}

}  // namespace kaamos::effects
