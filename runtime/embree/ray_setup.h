// SPDX-License-Identifier: MIT
//
// Prepares the rays of TraceRay and RayQuery before Embree sees them.
#pragma once

#include <cfloat>
#include <limits>

#include "runtime/embree/memory.h"
#include "runtime/embree/ray_state.h"

namespace kaamos::embree {

// The GeometryClass bits that a ray visits, by its four flags that cull or skip classes (bits 6 to
// 9) and by the instance's opacity. CULL_OPAQUE applies to the opacity after the instance's
// override. [DXR: Ray flags]
struct ClassTable {
  uint8_t classes[16][3];

  constexpr ClassTable() : classes{} {
    for (uint32_t flags = 0; flags < 16; ++flags) {
      uint32_t skipped = 0;
      if ((flags & 4) != 0) skipped |= kTriangleOpaque | kTriangleNonOpaque | kTriangleMicromap;
      if ((flags & 8) != 0) skipped |= kProceduralOpaque | kProceduralNonOpaque;
      const uint32_t all = kAllClasses & ~skipped;
      const bool cull_opaque = (flags & 1) != 0;
      const bool cull_non_opaque = (flags & 2) != 0;
      uint32_t by_geometry = all;
      if (cull_opaque) by_geometry &= ~uint32_t{kTriangleOpaque | kProceduralOpaque};
      if (cull_non_opaque) by_geometry &= ~uint32_t{kTriangleNonOpaque | kProceduralNonOpaque};
      classes[flags][static_cast<int>(OpacityOverride::kNone)] = static_cast<uint8_t>(by_geometry);
      classes[flags][static_cast<int>(OpacityOverride::kOpaque)] =
          static_cast<uint8_t>(cull_opaque ? 0 : all);
      classes[flags][static_cast<int>(OpacityOverride::kNonOpaque)] =
          static_cast<uint8_t>(cull_non_opaque ? 0 : all);
    }
  }
};
inline constexpr ClassTable kClassTable;

// Rays that Embree may get; every other ray, with NaN for example, misses.
inline bool is_valid(const ObjectRay& spatial, float t_min, float t_max) {
  return is_traceable(spatial) && t_min <= t_max && t_min <= FLT_MAX;
}

inline bool makes_non_opaque(uint32_t flags) {
  return (flags & (kRayForceOpaque | kRayForceNonOpaque)) == kRayForceNonOpaque;
}

// Out of line, because only a ray against a different structure than the last one gets here.
[[gnu::noinline]] inline const TopLevel* look_up_top_level(Worker& worker, uint64_t address) {
  worker.cached_top_level = worker.dispatch->memory->find_top_level(address);
  worker.cached_address = address;
  if (worker.cached_top_level == nullptr && address != 0) {
    worker.dispatch->unknown_structure.store(address, std::memory_order_relaxed);
  }
  return worker.cached_top_level.get();
}

inline const TopLevel* find_top_level(Worker& worker, uint64_t address) {
  if (address == worker.cached_address) [[likely]]
    return worker.cached_top_level.get();
  return look_up_top_level(worker, address);
}

// Sets what the rays of several lanes have in common. `flags` include the pipeline's, except for a
// RayQuery, which has kRayAllowsMicromaps of its own.
inline void begin_searches(RayState& state, uint32_t flags, uint32_t inclusion_mask,
                           const TopLevel* top_level) {
  shim::init(state.query);
  state.top_level = top_level;
  state.ray_flags = flags;
  state.inclusion_mask = inclusion_mask & 0xFFu;
  state.classes = kClassTable.classes[(flags >> 6) & 15];
  state.opacity = (flags & kRayForceOpaque) != 0      ? OpacityOverride::kOpaque
                  : (flags & kRayForceNonOpaque) != 0 ? OpacityOverride::kNonOpaque
                                                      : OpacityOverride::kNone;
  state.search = nullptr;
}

// Sets what differs from ray to ray. `t_near`, `t_far`: as in RayState.
inline void begin_search(RayState& state, float t_min, float t_max, float t_near, float t_far) {
  state.ended = false;
  // A negative TMin is undefined in DXR; here it is 0.
  state.t_min = t_min > 0 ? t_min : 0.0f;
  state.t_max = t_max;
  state.t_near = t_near;
  state.t_far = t_far;
  state.committed_t = std::numeric_limits<float>::infinity();
}

inline void begin_search(RayState& state, uint32_t flags, uint32_t inclusion_mask,
                         const TopLevel* top_level, float t_min, float t_max) {
  begin_searches(state, flags, inclusion_mask, top_level);
  begin_search(state, t_min, t_max, next_above(t_min > 0 ? t_min : 0.0f), next_below(t_max));
}

// `closed`: with the closed interval, which boxes have, instead of the open one of triangles.
inline void begin_embree_ray(const RayState& state, const ObjectRay& world, bool closed,
                             RTCRay& ray) {
  _mm_store_ps(&ray.org_x, with_fourth_lane(world.origin, closed ? state.t_min : state.t_near));
  _mm_store_ps(&ray.dir_x, world.direction);  // time 0
  ray.tfar = closed ? state.t_max : state.t_far;
  ray.mask = kAllClasses;
  ray.id = 0;
  ray.flags = 0;
}

inline void begin_embree_ray(const RayState& state, const ObjectRay& world, RTCRay& ray) {
  begin_embree_ray(state, world, state.top_level->has_procedurals(), ray);
}

// For a top level with exact bottom levels. False: the ray passes all instances at a distance.
inline bool begin_exact_ray(RayState& state, ExactState& exact, const ObjectRay& world,
                            RTCRay& ray) {
  state.exact = &exact;
  exact.filter = state.top_level->pack_filter();
  exact.hit_opaque = false;
  begin_embree_ray(state, world, true, ray);
  if (!state.top_level->boxes().empty()) return true;
  EmbreeRay& local = exact.in_top_level;
  if (!local.set(in_double(state.values.ray), state.top_level->frame())) return false;
  const float t_near = local.near_of(state.t_min);
  _mm_store_ps(&ray.org_x, _mm_setr_ps(local.origin[0], local.origin[1], local.origin[2], t_near));
  _mm_store_ps(&ray.dir_x,
               _mm_setr_ps(local.direction[0], local.direction[1], local.direction[2], 0));
  ray.tfar = local.far_of(state.t_max);
  return true;
}

}  // namespace kaamos::embree
