// SPDX-License-Identifier: MIT
#include "effects/assets/image/flicker.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace kaamos::effects {
namespace {

constexpr double kDepthTolerance = 0.02;  // relative

std::string size_of(const FloatImage& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height) + "x" +
         std::to_string(image.channels);
}

// The four pixels around a place in the previous frame, and their weights.
struct Taps {
  std::uint32_t x[4], y[4];
  double weight[4];
};

// Finds where the pixel's surface was in the previous frame; empty if it was not visible.
std::optional<Taps> find(const FloatImage& previous_view_z, const FrameSurfaces& surfaces,
                         std::uint32_t x, std::uint32_t y) {
  const double z = surfaces.view_z.at(x, y);
  if (!(z > 0.0)) return {};
  const double width = surfaces.view_z.width, height = surfaces.view_z.height;
  const double before_x = x + surfaces.motion.at(x, y, 0) * width;
  const double before_y = y + surfaces.motion.at(x, y, 1) * height;
  const double expected = z + surfaces.motion.at(x, y, 2);
  if (!(before_x >= 0.0 && before_y >= 0.0 && before_x <= width - 1 && before_y <= height - 1)) {
    return {};
  }
  const auto x0 = static_cast<std::uint32_t>(before_x), y0 = static_cast<std::uint32_t>(before_y);
  const double part_x = before_x - x0, part_y = before_y - y0;
  Taps taps;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t right = i & 1, down = i >> 1;
    taps.weight[i] = (right ? part_x : 1 - part_x) * (down ? part_y : 1 - part_y);
    // A tap with zero weight may lie outside the picture.
    taps.x[i] = std::min(x0 + right, surfaces.view_z.width - 1);
    taps.y[i] = std::min(y0 + down, surfaces.view_z.height - 1);
    if (taps.weight[i] == 0.0) continue;
    const double seen = previous_view_z.at(taps.x[i], taps.y[i]);
    if (!(seen > 0.0) || !(std::abs(seen - expected) <= kDepthTolerance * std::abs(expected)))
      return {};
  }
  return taps;
}

}  // namespace

void TemporalChange::add(const TemporalChange& other) {
  difference += other.difference;
  value += other.value;
  count += other.count;
  hidden += other.hidden;
  not_finite += other.not_finite;
}

Result<TemporalChange> temporal_change(const FloatImage& then, const FloatImage& now,
                                       const FloatImage& previous_view_z,
                                       const FrameSurfaces& surfaces) {
  const auto fits = [&](const FloatImage& image) {
    return image.width == now.width && image.height == now.height;
  };
  if (!fits(then) || then.channels != now.channels || !fits(previous_view_z) ||
      !fits(surfaces.view_z) || !fits(surfaces.motion) || surfaces.motion.channels < 3) {
    return make_error(ErrorId::kPictures, "pictures of a sequence must be of one size: then " +
                                              size_of(then) + ", now " + size_of(now) +
                                              ", depths " + size_of(previous_view_z) + " and " +
                                              size_of(surfaces.view_z) + ", motion " +
                                              size_of(surfaces.motion) + " (3 channels or more)");
  }
  const std::uint32_t channels = std::min(now.channels, 3u);
  TemporalChange sum;
  for (std::uint32_t y = 0; y < now.height; ++y) {
    for (std::uint32_t x = 0; x < now.width; ++x) {
      const auto taps = find(previous_view_z, surfaces, x, y);
      if (!taps) {
        ++sum.hidden;
        continue;
      }
      for (std::uint32_t c = 0; c < channels; ++c) {
        double before = 0.0;
        for (std::uint32_t i = 0; i < 4; ++i) {
          if (taps->weight[i] > 0.0) before += taps->weight[i] * then.at(taps->x[i], taps->y[i], c);
        }
        const double value = now.at(x, y, c);
        if (!std::isfinite(value) || !std::isfinite(before)) {
          ++sum.not_finite;
          continue;
        }
        sum.difference += std::abs(value - before);
        sum.value += std::abs(value);
        ++sum.count;
      }
    }
  }
  return sum;
}

}  // namespace kaamos::effects
