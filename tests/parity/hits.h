// SPDX-License-Identifier: MIT
//
// Compares what one ray found on one backend and on another, and says how far apart the two may be.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kaamos::parity {

// As probe.hlsl writes it. All zero where the ray missed, except for `flags`.
struct HitRecord {
  uint32_t hit = 0;
  uint32_t instance_index = 0;
  uint32_t instance_id = 0;
  uint32_t primitive = 0;
  uint32_t geometry = 0;
  uint32_t kind = 0;
  uint32_t record = 0;  // of the hit group table, from the record's root constant
  uint32_t flags = 0;   // RayFlags(), as the last shader saw them
  float t = 0;
  float barycentrics[2] = {0, 0};
  float cosine = 0;  // between the ray and the triangle's normal, absolute
  float object_point[3] = {0, 0, 0};
  float surface_point[3] = {0, 0, 0};  // world, from the triangle's corners and the barycentrics
  float coordinate = 0;                // the largest one that the hit was computed from, world
};
static_assert(sizeof(HitRecord) == 76);

// The project's tolerances. The two traversals round differently, so what may differ is what
// rounding decides: which of two triangles at the same place is hit, and whether an edge is.
struct HitLimits {
  double visibility =
      1e-4;  // share of rays: one hits and the other misses, or something else is behind
  double silhouettes = 5e-3;  // share of rays: another triangle at the same t, or a neighbour's
  // Away from grazing: the error of t and of the hit's position in the triangle. For a short t, the
  // last places of coordinates are allowed on top: some 8 units in the last place of the largest.
  double t_relative = 1e-4;
  double per_coordinate = 1e-6;
  // Share of rays whose position may be off: barycentrics of slivers, which rounding moves along
  // them, and of very large triangles; points on objects much smaller than their instances.
  double places = 1e-4;
  double grazing_cosine = 0.05;
};

enum class HitChange : uint8_t {
  kNone,        // the same, within the tolerances
  kSilhouette,  // another triangle, tied with this one or adjacent to it in the picture
  kVisibility,  // hit against miss, or a far hit
  kInteger,     // the same triangle, but one of its integers differs
  kPlace,       // the same triangle at the same t, but another position in it or in its object
  kNumber,      // the same triangle, but t is too far apart, or a number is NaN
};

struct HitDifference {
  uint64_t rays = 0;
  uint64_t hits = 0;  // in `a`
  uint64_t counts[6] = {0, 0, 0, 0, 0, 0};
  double worst_t = 0;  // the largest error of t away from grazing, relative to what is allowed
  // The worst ray of the worst kind: its index, and the difference in words; empty if nothing
  // differs.
  HitChange worst_change = HitChange::kNone;
  uint64_t worst_ray = 0;
  std::string worst_text;

  uint64_t count(HitChange change) const { return counts[static_cast<int>(change)]; }
};

// `width`: width of the picture whose pixels the rays are, row by row; 0 if they are not pixels.
HitDifference compare_hits(const std::vector<HitRecord>& a, const std::vector<HitRecord>& b,
                           uint32_t width, const HitLimits& limits = {});

// Says which limits the difference exceeds; empty if none.
std::string judge(const HitDifference& difference, const HitLimits& limits = {});
// One line of the counts.
std::string describe(const HitDifference& difference);
std::string describe(const HitRecord& hit);

}  // namespace kaamos::parity
