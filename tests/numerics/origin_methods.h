// SPDX-License-Identifier: MIT
//
// Ways to start a ray on a triangle: how often each of them hits that triangle again or steps over
// something close to it.
#pragma once

#include <array>
#include <cstdint>

#include "ray_probe.h"

namespace kaamos::test {

enum OriginMethod : std::uint32_t {
  kNoOffset,       // the point itself, TMin 0
  kFixedTMin,      // the point itself, TMin 1e-3 m
  kFixedOffset,    // 1e-3 m along the normal
  kIntegerOffset,  // 256 float steps along the normal [Ray Tracing Gems, chapter 6]
  kErrorBound,     // make_spawn_point: what the effects do
  kOriginMethodCount
};

struct OriginPlace {
  double distance = 0;  // metres from the origin of the coordinates
  double scale = 1;     // size of the triangles, in a cube of 2 m
  double stretch = 1;   // additional scale along one axis of the instance
};

struct OriginRates {
  double self_hits = 0;  // share of the rays that hit their own triangle
  double leaks = 0;      // share that step over a sheet at a hundredth of the cube's side
  double offset = 0;     // mean, metres
};

// Traces rays in all directions of a hemisphere from points on random triangles: `triangles` times
// `rays` for each method.
std::array<OriginRates, kOriginMethodCount> measure_origins(RayProbe& probe,
                                                            const OriginPlace& place,
                                                            std::uint32_t triangles,
                                                            std::uint32_t rays);

}  // namespace kaamos::test
