// SPDX-License-Identifier: MIT
#include "effects/assets/image/edge_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace kaamos::effects {

namespace {

// A step must be more than this part of the nearer depth, besides what the surface's slope
// explains.
constexpr double kTolerance = 0.03;

// Returns whether an edge is between the second and the third of four depths in a line; 0: there is
// no surface, or the picture has ended.
bool is_edge(double before, double left, double right, double after) {
  if ((left > 0) != (right > 0)) return true;
  if (!(left > 0)) return false;
  // On a plane the reciprocal is linear over the picture.
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  const auto step = [](double a, double b) {
    return a > 0 && b > 0 ? std::abs(1 / b - 1 / a) : kUnknown;
  };
  // The smaller of the two sides: a thin thing has an edge on both.
  const double side = std::min(step(before, left), step(right, after));
  const double slope = side == kUnknown ? 0 : side;
  return step(left, right) > 2 * slope + kTolerance / std::max(left, right);
}

}  // namespace

std::vector<bool> edge_band(const FloatImage& view_z, std::uint32_t reach) {
  const auto width = static_cast<int>(view_z.width), height = static_cast<int>(view_z.height);
  const auto depth = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height) return 0.0;
    return double{view_z.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))};
  };
  std::vector<bool> out(view_z.values.size() / view_z.channels);
  const auto mark = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    out[static_cast<std::size_t>(y) * view_z.width + static_cast<std::size_t>(x)] = true;
  };
  const int before = static_cast<int>(reach);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1)}) {
        if (x + dx >= width || y + dy >= height) continue;
        if (!is_edge(depth(x - dx, y - dy), depth(x, y), depth(x + dx, y + dy),
                     depth(x + 2 * dx, y + 2 * dy))) {
          continue;
        }
        for (int i = 1 - before; i <= before; ++i) mark(x + i * dx, y + i * dy);
      }
    }
  }
  return out;
}

}  // namespace kaamos::effects
