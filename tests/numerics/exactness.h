// SPDX-License-Identifier: MIT
//
// How many hits are wrong on a closed mesh, and how far hit data is from the truth: at which size,
// how far from the origin, seen from how far away.
#pragma once

#include <string>
#include <vector>

#include "ray_probe.h"

namespace kaamos::test {

struct Placement {
  float scale;   // radius of the mesh in metres
  float scene;   // how far its instance and all rays are from the origin, in metres along x and y
  float camera;  // how far outside the mesh rays start, in radii; 0: inside
};
// Scales 1e-9 to 1e12, scene 0 to 1e6, camera 0 to 1e6.
std::vector<Placement> all_placements();
std::string name_of(const Placement& placement);

enum class Aim { kEdge, kVertex, kRandom };
inline constexpr Aim kAims[] = {Aim::kEdge, Aim::kVertex, Aim::kRandom};

// Rays whose count of triangles is wrong. [DXR: Watertightness; Top-left rule]
struct WrongHits {
  std::uint32_t wrong = 0;  // from inside not 1, from outside odd
  std::uint32_t gaps = 0;   // of them: no triangle at all, from inside
};
WrongHits count_wrong_hits(RayProbe& probe, const Placement& placement, Aim aim,
                           std::uint32_t rays);

// Against long double, of hits that are not grazing (0.05 of the largest determinant): the largest,
// and 99 of 100.
struct HitErrors {
  double t = 0;             // in ulp of a float
  double barycentrics = 0;  // in 2^-24, the ulp of values from 0.5 on
  double t_99 = 0;
  double barycentrics_99 = 0;
};
HitErrors measure_hit_errors(RayProbe& probe, const Placement& placement, std::uint32_t rays);

// Rays at the mesh of a placement, a third for each aim.
std::vector<ProbeRay> mixed_rays(const Placement& placement, std::uint32_t rays);
ProbeMesh mesh_of(const Placement& placement);

}  // namespace kaamos::test
