// SPDX-License-Identifier: MIT
//
// Ways to start a ray on a triangle, and how often each meets that triangle again or steps over
// what is close to it. [effects-spec B0.5]
#pragma once

#include <array>
#include <cstdint>

#include "ray_probe.h"

namespace kaamos::test {

enum OriginMethod : std::uint32_t {
  kNoOffset,       // the point itself, TMin 0
  kFixedTMin,      // the point itself, TMin 1e-3 m
  kFixedOffset,    // 1e-3 m along the normal
  kIntegerOffset,  // 256 steps of a float along the normal [Ray Tracing Gems, chapter 6]
  kErrorBound,     // make_spawn_point: what the effects do
  kOriginMethodCount
};

struct OriginPlace {
  double distance = 0;  // metres from the origin that positions are relative to
  double scale = 1;     // of triangles in a cube of 2 m
  double stretch = 1;   // how much more along one axis of the instance
};

struct OriginRates {
  double self_hits = 0;  // part of the rays that meet their own triangle
  double leaks = 0;      // that step over a sheet at a hundredth of the cube's side
  double offset = 0;     // mean, metres
};

// Rays in all directions of a half space from points of random triangles, `triangles` times `rays`
// for each method.
std::array<OriginRates, kOriginMethodCount> measure_origins(RayProbe& probe,
                                                            const OriginPlace& place,
                                                            std::uint32_t triangles,
                                                            std::uint32_t rays);

}  // namespace kaamos::test
