// SPDX-License-Identifier: MIT
#include "runtime/raster/line_setup.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "runtime/raster/edges.h"

namespace kaamos::raster {
namespace {

// A place by the direction in which a line changes more, the major one, and the other.
struct Place {
  int32_t major, minor;
};

int64_t floor_divide(int64_t a, int64_t b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

int32_t center_of(int32_t pixel) {
  return pixel * kSubpixels + kPixelCenter;
}

struct Line {
  Place from, to;
  bool along_x;

  // The column (or row) of a place. The lower corner of a pixel's diamond belongs to it, and so its
  // lower border where rows count.
  int32_t column_of(int32_t major) const { return (along_x ? major : major - 1) >> kSubpixelBits; }
  // The pixel that the line, made longer, passes in a column: its centre is less than half a pixel
  // above (or left of) the line, or up to half a pixel below (or right of) it.
  int32_t row_at(int32_t column) const {
    const int64_t sign = to.major > from.major ? 1 : -1;
    const int64_t length = (to.major - from.major) * sign;
    const int64_t rise =
        static_cast<int64_t>(to.minor - from.minor) * (center_of(column) - from.major) * sign;
    const int64_t place = from.minor * length + rise;
    return static_cast<int32_t>(floor_divide(place - 1, length * kSubpixels));
  }
  // Whether a place in the column is in the diamond of the pixel that the line passes there. Of the
  // diamond's border, the lower edges and the lower corner belong to it, and the right corner of
  // lines along y.
  bool in_diamond(const Place& place, int32_t column) const {
    const int32_t major = place.major - center_of(column);
    const int32_t minor = place.minor - center_of(row_at(column));
    const int32_t distance = std::abs(major) + std::abs(minor);
    if (distance != kPixelCenter) return distance < kPixelCenter;
    return along_x ? minor > 0 : major > 0 || (major == 0 && minor > 0);
  }
  // The columns whose diamonds the line leaves.
  void columns(int32_t& first, int32_t& last) const {
    const bool forward = to.major > from.major;
    const int32_t step = forward ? 1 : -1;
    const auto before = [&](int32_t a, int32_t b) { return forward ? a < b : a > b; };
    int32_t begin = column_of(from.major);
    if (before(center_of(begin), from.major) && !in_diamond(from, begin)) begin += step;
    int32_t end = column_of(to.major);
    if (before(to.major, center_of(end)) || in_diamond(to, end)) end -= step;
    first = forward ? begin : end;
    last = forward ? end : begin;
  }
};

}  // namespace

SetUp set_up_line(const PixelRect& rect, const ScreenVertex v[2], Triangle& out) {
  const int32_t dx = v[1].x - v[0].x, dy = v[1].y - v[0].y;
  if (dx == 0 && dy == 0) return SetUp::kZeroArea;
  Line line;
  line.along_x = is_along_x(dx, dy);
  line.from = line.along_x ? Place{v[0].x, v[0].y} : Place{v[0].y, v[0].x};
  line.to = line.along_x ? Place{v[1].x, v[1].y} : Place{v[1].y, v[1].x};
  int32_t first, last;
  line.columns(first, last);
  if (first > last) return SetUp::kNoPixel;
  const auto [low, high] = std::minmax({line.row_at(first), line.row_at(last)});
  const PixelRect reach = line.along_x ? PixelRect{first, low, last + 1, high + 1}
                                       : PixelRect{low, first, high + 1, last + 1};
  if (set_box(rect, reach, out).empty()) return SetUp::kNoPixel;
  // As far to the side as the line is long, so that the plane is well conditioned.
  const ScreenVertex side = {v[0].x + (line.along_x ? 0 : -dy), v[0].y + (line.along_x ? dx : 0),
                             v[0].z, v[0].inv_w};
  const ScreenVertex corners[3] = {v[0], v[1], side};
  for (int i = 0; i < 3; ++i) {
    out.x[i] = corners[i].x;
    out.y[i] = corners[i].y;
    out.z[i] = corners[i].z;
  }
  const auto length = static_cast<double>(line.along_x ? dx : dy);
  set_depth_plane(out, length * length);
  out.flags = kLine | kMasked;
  return SetUp::kDone;
}

void line_rectangle(const ScreenVertex ends[2], ScreenVertex corners[4]) {
  constexpr double kHalfWidth = 0.7 * kSubpixels;
  const double dx = ends[1].x - ends[0].x, dy = ends[1].y - ends[0].y;
  const double length = std::hypot(dx, dy);
  const auto across = [&](double difference) {
    return length == 0 ? 0 : static_cast<int32_t>(std::lround(difference / length * kHalfWidth));
  };
  for (int i = 0; i < 4; ++i) {
    corners[i] = ends[i / 2];
    const int32_t sign = i % 2 == 0 ? 1 : -1;
    corners[i].x += sign * across(-dy);
    corners[i].y += sign * across(dx);
  }
}

void point_square(const ScreenVertex& point, ScreenVertex corners[4]) {
  for (int i = 0; i < 4; ++i) {
    corners[i] = point;
    corners[i].x += i / 2 == 0 ? -kPixelCenter : kPixelCenter;
    corners[i].y += i % 2 == 0 ? -kPixelCenter : kPixelCenter;
  }
}

}  // namespace kaamos::raster
