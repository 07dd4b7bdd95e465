// SPDX-License-Identifier: MIT
//
// Visits an instance in robust and fast precision: decides by the instance's mask and flags what
// the ray sees of it, transforms the ray to object space, and traverses the bottom level with it.
// For top levels with exact bottom levels see exact_traverse.cpp.
#include "runtime/embree/far_rays.h"
#include "runtime/embree/inline_query.h"
#include "runtime/embree/instance_level.h"
#include "runtime/embree/lane_rays.h"

namespace kaamos::embree {
namespace {

struct Visit {
  template <typename HitHere, typename Trace>
  void operator()(RayState& state, uint32_t index, uint32_t classes, RTCRay& ray, bool committed,
                  HitHere hit_here, Trace trace) const {
    const InstanceNode& node = state.top_level->nodes()[index];
    const __m128 world_origin = _mm_load_ps(&ray.org_x);     // w: tnear
    const __m128 world_direction = _mm_load_ps(&ray.dir_x);  // w: time
    const ObjectRay object = to_object_space(node, world_origin, world_direction);
    if (!is_traceable(object)) [[unlikely]]
      return note_far_ray(state, index);
    // In a top level with procedural instances Embree's ray has the closed interval. Triangles must
    // see the open one, which also ends just before a committed hit. [DXR: Ray extents]
    const float t_far = ray.tfar;
    const bool mixed = state.top_level->has_procedurals();
    const float t_near = mixed && node.procedural ? state.t_min : state.t_near;
    if (mixed && !node.procedural) ray.tfar = committed ? next_below(t_far) : state.t_far;
    // Full-width stores: Embree loads origin and tnear at once, and would stall on two partial
    // stores.
    _mm_store_ps(&ray.org_x, with_fourth_lane(object.origin, t_near));
    _mm_store_ps(&ray.dir_x, object.direction);
    ray.mask = classes;
    state.instance = &node;
    shim::set_instance(state.query, index);
    select_filter(state, node);

    trace(node.scene);

    _mm_store_ps(&ray.org_x, world_origin);
    _mm_store_ps(&ray.dir_x, world_direction);
    ray.mask = kAllClasses;
    shim::set_instance(state.query, RTC_INVALID_GEOMETRY_ID);
    if (mixed && !hit_here()) ray.tfar = t_far;
  }
};

using Instances = InstanceLevel<Visit>;

}  // namespace

void intersect_instance(const RTCIntersectFunctionNArguments* arguments) {
  Instances::intersect(arguments);
}

void occlude_instance(const RTCOccludedFunctionNArguments* arguments) {
  Instances::occlude(arguments);
}

void intersect_member(const RTCIntersectFunctionNArguments* arguments) {
  Instances::intersect_member(arguments);
}

void occlude_member(const RTCOccludedFunctionNArguments* arguments) {
  Instances::occlude_member(arguments);
}

void intersect(RayState& state, RTCRayHit& ray_hit) {
  const TopLevel& top_level = *state.top_level;
  if (top_level.boxes().empty()) return shim::intersect(top_level.scene(), state.query, &ray_hit);
  if (top_level.has_exact()) return intersect_exactly(state, ray_hit);
  Instances::intersect(state, ray_hit);
}

void occlude(RayState& state, RTCRay& ray) {
  const TopLevel& top_level = *state.top_level;
  if (top_level.boxes().empty()) return shim::occluded(top_level.scene(), state.query, &ray);
  if (top_level.has_exact()) return occlude_exactly(state, ray);
  Instances::occlude(state, ray);
}

void intersect(RayState& state, RTCRayHit& ray_hit, const LaneSearches& lanes, int lane) {
  Instances::intersect(state, ray_hit, lanes.entered[lane], lanes.entries_of(lane));
}

void occlude(RayState& state, RTCRay& ray, const LaneSearches& lanes, int lane) {
  Instances::occlude(state, ray, lanes.entered[lane], lanes.entries_of(lane));
}

}  // namespace kaamos::embree
