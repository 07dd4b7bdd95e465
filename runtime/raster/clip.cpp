// SPDX-License-Identifier: MIT
#include "runtime/raster/clip.h"

#include <cmath>
#include <cstring>

namespace kaamos::raster {
namespace {

struct Clipper {
  ClipVertex* polygon;
  int corners;  // 2: a line, which has no edge from its end to its start
  int count;
  uint32_t distances;

  // `side(v)` is negative outside; `settle(v)` moves a new vertex exactly onto the plane.
  template <class Side, class Settle>
  void cut(const Side& side, const Settle& settle) {
    if (count == 0) return;
    double sides[kMaxClippedVertices];
    bool any_outside = false;
    for (int i = 0; i < count; ++i) {
      sides[i] = side(polygon[i]);
      any_outside = any_outside || sides[i] < 0;
    }
    if (!any_outside) return;
    ClipVertex result[kMaxClippedVertices];
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      const int next = i + 1 == count ? 0 : i + 1;
      if (sides[i] >= 0) result[kept++] = polygon[i];
      if ((sides[i] < 0) == (sides[next] < 0) || (corners == 2 && next == 0)) continue;
      // From inside to outside, whichever comes first.
      const bool leaves = sides[i] >= 0;
      const int in = leaves ? i : next;
      const int out = leaves ? next : i;
      // A vertex on the plane is its own cut.
      if (sides[in] == 0) continue;
      result[kept] = between(polygon[in], polygon[out], sides[in] / (sides[in] - sides[out]));
      settle(result[kept++]);
    }
    count = kept < corners ? 0 : kept;
    std::memcpy(polygon, result, sizeof(ClipVertex) * static_cast<size_t>(count));
  }

  ClipVertex between(const ClipVertex& a, const ClipVertex& b, double t) const {
    ClipVertex v;
    v.x = a.x + t * (b.x - a.x);
    v.y = a.y + t * (b.y - a.y);
    v.z = a.z + t * (b.z - a.z);
    v.w = a.w + t * (b.w - a.w);
    for (int i = 0; i < 3; ++i) v.weight[i] = a.weight[i] + t * (b.weight[i] - a.weight[i]);
    for (uint32_t i = 0; i < distances; ++i) {
      v.distance[i] = a.distance[i] + t * (b.distance[i] - a.distance[i]);
    }
    return v;
  }

  // Keeps coordinate / w * scale + offset on one side of `limit`.
  void cut_guard(double ClipVertex::*coordinate, double scale, double offset, double limit,
                 double sign) {
    const double shift = offset - limit;
    cut([&](const ClipVertex& v) { return sign * (v.*coordinate * scale + v.w * shift); },
        [&](ClipVertex& v) {
          const double exact = -v.w * shift / scale;
          if (std::isfinite(exact)) v.*coordinate = exact;
        });
  }
};

}  // namespace

int clip(const ClipPlanes& planes, const ViewportState& viewport, int corners,
         ClipVertex polygon[kMaxClippedVertices]) {
  Clipper clipper{polygon, corners, corners, planes.distances};
  const double least_w = static_cast<double>(kLeastW);
  clipper.cut([&](const ClipVertex& v) { return v.w - least_w; },
              [&](ClipVertex& v) { v.w = least_w; });
  if (planes.depth) {
    clipper.cut([](const ClipVertex& v) { return v.z; }, [](ClipVertex& v) { v.z = 0; });
    clipper.cut([](const ClipVertex& v) { return v.w - v.z; }, [](ClipVertex& v) { v.z = v.w; });
  }
  for (uint32_t i = 0; i < planes.distances; ++i) {
    if ((planes.used_distances >> i & 1) == 0) continue;
    clipper.cut([i](const ClipVertex& v) { return v.distance[i]; },
                [i](ClipVertex& v) { v.distance[i] = 0; });
  }
  const auto wide = [](float value) { return static_cast<double>(value); };
  for (const float limit : {kGuardLow, kGuardHigh}) {
    const double sign = limit == kGuardLow ? 1 : -1;
    clipper.cut_guard(&ClipVertex::x, wide(viewport.scale_x), wide(viewport.offset_x), wide(limit),
                      sign);
    clipper.cut_guard(&ClipVertex::y, wide(viewport.scale_y), wide(viewport.offset_y), wide(limit),
                      sign);
  }
  return clipper.count;
}

}  // namespace kaamos::raster
