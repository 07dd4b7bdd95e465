// SPDX-License-Identifier: MIT
#include "runtime/raster/triangle_setup.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "runtime/raster/edges.h"

namespace kaamos::raster {
namespace {

// 2^(exponent of z - 23), the distance of floats there.
float step_of(float z) {
  const uint32_t exponent = std::bit_cast<uint32_t>(z) >> 23 & 0xFF;
  return exponent > 23 ? std::bit_cast<float>((exponent - 23) << 23) : 0.0f;
}

float bias_of(const DrawPlan& plan, const Triangle& t) {
  float unit;
  switch (plan.bias_kind) {
    case DepthKind::kUnorm16:
      unit = 1.0f / 65535.0f;
      break;
    case DepthKind::kUnorm24:
      unit = 1.0f / 16777215.0f;
      break;
    default:
      unit = step_of(std::max({std::fabs(t.z[0]), std::fabs(t.z[1]), std::fabs(t.z[2])}));
  }
  float bias = plan.depth_bias * unit;
  if (plan.slope_bias != 0) {
    const double slope = std::max(std::fabs(t.dz_dx), std::fabs(t.dz_dy)) * kSubpixels;
    bias += plan.slope_bias * static_cast<float>(slope);
  }
  if (plan.bias_clamp > 0) return std::min(plan.bias_clamp, bias);
  if (plan.bias_clamp < 0) return std::max(plan.bias_clamp, bias);
  return bias;
}

// Returns whether one of the blocks of 4 x 2 pixels that the box touches reaches beyond `rect`.
bool needs_masks(const PixelRect& box, const PixelRect& rect) {
  return (box.left & ~3) < rect.left || ((box.right + 3) & ~3) > rect.right ||
         (box.top & ~1) < rect.top || ((box.bottom + 1) & ~1) > rect.bottom;
}

// Positive: clockwise, as y points down.
int64_t area_of(const ScreenVertex v[3]) {
  const int64_t dx1 = v[1].x - v[0].x, dy1 = v[1].y - v[0].y;
  const int64_t dx2 = v[2].x - v[0].x, dy2 = v[2].y - v[0].y;
  return dx1 * dy2 - dx2 * dy1;
}

struct Facing {
  bool front = true;
  bool culled = false;
};

Facing facing_of(const DrawPlan& plan, int64_t area) {
  const bool front = (area > 0) == plan.front_is_clockwise;
  return {front, front ? plan.cull_front : plan.cull_back};
}

// Position, depth, and the flags that say what they are.
[[gnu::always_inline]] inline void place(const DrawPlan& plan, const ScreenVertex v[3],
                                         int64_t area, Facing facing, bool biased, Triangle& out) {
  const bool swap = area < 0;
  const int order[3] = {0, swap ? 2 : 1, swap ? 1 : 2};
  for (int i = 0; i < 3; ++i) {
    out.x[i] = v[order[i]].x;
    out.y[i] = v[order[i]].y;
    out.z[i] = v[order[i]].z;
  }
  const auto magnitude = static_cast<double>(swap ? -area : area);
  set_depth_plane(out, magnitude);
  if (biased) {
    const float bias = bias_of(plan, out);
    for (float& z : out.z) z += bias;
    set_depth_plane(out, magnitude);
  }
  out.flags =
      (facing.front ? kFrontFacing : 0u) | (swap ? kSwapped : 0u) | (facing.culled ? kCulled : 0u);
}

}  // namespace

void set_depth_plane(Triangle& t, double area) {
  const double dz1 = static_cast<double>(t.z[1]) - static_cast<double>(t.z[0]);
  const double dz2 = static_cast<double>(t.z[2]) - static_cast<double>(t.z[0]);
  const double dx1 = t.x[1] - t.x[0], dy1 = t.y[1] - t.y[0];
  const double dx2 = t.x[2] - t.x[0], dy2 = t.y[2] - t.y[0];
  t.dz_dx = (dz1 * dy2 - dz2 * dy1) / area;
  t.dz_dy = (dz2 * dx1 - dz1 * dx2) / area;
}

SetUp orient_triangle(const DrawPlan& plan, const ScreenVertex v[3], Orientation& out) {
  const int64_t area = area_of(v);
  if (area == 0) return SetUp::kZeroArea;
  const Facing facing = facing_of(plan, area);
  if (facing.culled) return SetUp::kCulled;
  out.front = facing.front;
  if (plan.biased) {
    Triangle placed;
    place(plan, v, area, facing, false, placed);
    out.bias = bias_of(plan, placed);
  }
  return SetUp::kDone;
}

SetUp set_up_triangle(const DrawPlan& plan, const PixelRect& rect, const ScreenVertex v[3],
                      Triangle& out, PartOf part_of) {
  const int64_t area = area_of(v);
  if (area == 0) return SetUp::kZeroArea;
  const bool whole = part_of == PartOf::kTriangle;
  const Facing facing = whole ? facing_of(plan, area) : Facing{};
  if (facing.culled && !plan.keeps_culled) return SetUp::kCulled;
  const int32_t left = std::min({v[0].x, v[1].x, v[2].x});
  const int32_t right = std::max({v[0].x, v[1].x, v[2].x});
  const int32_t top = std::min({v[0].y, v[1].y, v[2].y});
  const int32_t bottom = std::max({v[0].y, v[1].y, v[2].y});
  const int32_t up = kSubpixels - 1 - plan.greatest_sample;
  const int32_t down = plan.least_sample;
  const PixelRect reach{(left + up) >> kSubpixelBits, (top + up) >> kSubpixelBits,
                        ((right - down) >> kSubpixelBits) + 1,
                        ((bottom - down) >> kSubpixelBits) + 1};
  const PixelRect box = set_box(rect, reach, out);
  if (box.empty()) return SetUp::kNoPixel;
  place(plan, v, area, facing, whole && plan.biased, out);
  // Rounding of the plane's gradients grows by the square of the length over the area.
  const int32_t length = std::max(right - left, bottom - top);
  const double square = static_cast<double>(length) * length;
  constexpr double kThin = 0x1p24;
  out.flags |= (square > kThin * static_cast<double>(std::abs(area)) ? kSliver : 0u) |
               (length <= kSmallSize ? kSmall : 0u) | (needs_masks(box, rect) ? kMasked : 0u);
  return SetUp::kDone;
}

}  // namespace kaamos::raster
