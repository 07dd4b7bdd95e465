// SPDX-License-Identifier: MIT
//
// Rays beyond the range that Embree takes. They miss, and the dispatch says so (KA0888).
#pragma once

#include <cstdint>
#include <string>

#include "runtime/embree/instance_node.h"

namespace kaamos::embree {

struct RayState;
struct Worker;

// Those that a thread, or all threads of a dispatch, have met.
struct FarRays {
  static constexpr uint32_t kWorld = UINT32_MAX;

  uint64_t count = 0;  // a ray counts in the world, or once for each instance
  // One of them: the least of all, so that it is the same for any number of threads.
  uint32_t instance = kWorld;  // in whose space it is too far away, or kWorld
  float ray[6] = {};           // origin, direction

  void add(const FarRays& other);
  std::string message(const char* label) const;
};

// Notes a ray that is_valid() refused. Rays with a NaN, an infinity or an empty interval miss by
// DXR's rules and are no news.
void note_far_ray(Worker& worker, const ObjectRay& world, float t_min, float t_max);
// Notes the ray of `state`, which is too far away in the space of `instance`.
void note_far_ray(const RayState& state, uint32_t instance);

}  // namespace kaamos::embree
