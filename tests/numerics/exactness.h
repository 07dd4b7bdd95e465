// SPDX-License-Identifier: MIT
//
// Measures how many hits on a closed mesh are wrong, and how far hit data is from the truth,
// depending on the mesh's size, its distance from the origin, and the distance from which it is
// seen.
#pragma once

#include <string>
#include <vector>

#include "ray_probe.h"

namespace kaamos::test {

struct Placement {
  float scale;   // radius of the mesh in metres
  float scene;   // distance of its instance and all rays from the origin, in metres along x and y
  float camera;  // how far outside the mesh rays start, in radii; 0: inside
};
// Scales 1e-9 to 1e12, scene 0 to 1e6, camera 0 to 1e6.
std::vector<Placement> all_placements();
std::string name_of(const Placement& placement);

enum class Aim { kEdge, kVertex, kRandom };
inline constexpr Aim kAims[] = {Aim::kEdge, Aim::kVertex, Aim::kRandom};

// Rays that meet a wrong number of triangles. [DXR: Watertightness; Top-left rule]
struct WrongHits {
  std::uint32_t wrong = 0;  // from inside: do not meet exactly 1; from outside: meet an odd number
  std::uint32_t gaps = 0;   // those among them that start inside and meet no triangle at all
};
WrongHits count_wrong_hits(RayProbe& probe, const Placement& placement, Aim aim,
                           std::uint32_t rays);

// Errors against long double of hits that do not graze (0.05 of the largest determinant): the
// largest, and the 99th percentile.
struct HitErrors {
  double t = 0;             // in float ulps
  double barycentrics = 0;  // in 2^-24, the ulp of values from 0.5 on
  double t_99 = 0;
  double barycentrics_99 = 0;
};
HitErrors measure_hit_errors(RayProbe& probe, const Placement& placement, std::uint32_t rays);

// Rays at a placement's mesh, one third for each kind of aim.
std::vector<ProbeRay> mixed_rays(const Placement& placement, std::uint32_t rays);
ProbeMesh mesh_of(const Placement& placement);

}  // namespace kaamos::test
