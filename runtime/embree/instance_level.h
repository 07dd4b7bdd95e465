// SPDX-License-Identifier: MIT
//
// The instance level of a traversal, for every precision: either the instances of a list of boxes
// in the order in which the ray enters them, or those of a tree, one for each callback from Embree.
// What a precision does at an instance is its Visit:
//   visit(state, index, classes, ray, committed, hit_here, trace)
// transforms `ray` to the instance's space, calls trace(bottom level) and transforms it back.
// `classes` are the GeometryClass bits that the ray sees of the instance; `committed` says that
// there was a hit before; hit_here() says whether this instance was hit.
#pragma once

#include "runtime/embree/inline_query.h"
#include "runtime/embree/ray_state.h"

namespace kaamos::embree {

// Facing flags, and an opacity that overrides the geometry's, affect hits that have no filter of
// their own; in these cases every hit must go through the filter.
inline void select_filter(RayState& state, const InstanceNode& node) {
  const OpacityOverride opacity =
      state.opacity != OpacityOverride::kNone ? state.opacity : node.opacity;
  constexpr uint32_t kFacingFlags = kRayCullBackFacingTriangles | kRayCullFrontFacingTriangles;
  const bool culls_facing =
      (state.ray_flags & kFacingFlags) != 0 && (node.flags & kInstanceTriangleCullDisable) == 0;
  const bool all_hits = culls_facing || opacity == OpacityOverride::kNonOpaque ||
                        (state.search != nullptr && state.search->any);
  shim::set_all_hits_filter(state.query, all_hits ? filter_every_triangle : nullptr);
}

template <typename Visit>
struct InstanceLevel {
  // For a top level that is a list of boxes.
  static void intersect(RayState& state, RTCRayHit& ray_hit) {
    state.top_level->boxes().for_each_entered(
        ray_hit.ray, [&](uint32_t index) { intersect_one(state, index, ray_hit); });
  }
  static void occlude(RayState& state, RTCRay& ray) {
    state.top_level->boxes().for_each_entered(
        ray, [&](uint32_t index) { occlude_one(state, index, ray); });
  }
  // For one where it is known which boxes the ray enters.
  template <uint32_t stride>
  static void intersect(RayState& state, RTCRayHit& ray_hit, EnteredBoxes boxes,
                        BoxEntries<stride> entry) {
    visit_entered(boxes, entry, ray_hit.ray,
                  [&](uint32_t index) { intersect_one(state, index, ray_hit); });
  }
  template <uint32_t stride>
  static void occlude(RayState& state, RTCRay& ray, EnteredBoxes boxes, BoxEntries<stride> entry) {
    visit_entered(boxes, entry, ray, [&](uint32_t index) { occlude_one(state, index, ray); });
  }

  // For one that is an Embree scene of PartitionGroups.
  static void intersect_member(const RTCIntersectFunctionNArguments* arguments) {
    const bool hit = intersect_one(ray_state_of(arguments->context), member_of(arguments),
                                   *reinterpret_cast<RTCRayHit*>(arguments->rayhit));
    shim::set_hit(arguments, hit);
  }
  static void occlude_member(const RTCOccludedFunctionNArguments* arguments) {
    const bool hit = occlude_one(ray_state_of(arguments->context), member_of(arguments),
                                 *reinterpret_cast<RTCRay*>(arguments->ray));
    shim::set_hit(arguments, hit);
  }
  // For one that is an Embree scene of one geometry.
  static void intersect(const RTCIntersectFunctionNArguments* arguments) {
    const bool hit = intersect_one(ray_state_of(arguments->context), arguments->primID,
                                   *reinterpret_cast<RTCRayHit*>(arguments->rayhit));
    shim::set_hit(arguments, hit);
  }
  static void occlude(const RTCOccludedFunctionNArguments* arguments) {
    const bool hit = occlude_one(ray_state_of(arguments->context), arguments->primID,
                                 *reinterpret_cast<RTCRay*>(arguments->ray));
    shim::set_hit(arguments, hit);
  }

 private:
  template <typename Arguments>
  static uint32_t member_of(const Arguments* arguments) {
    return static_cast<const uint32_t*>(arguments->geometryUserPtr)[arguments->primID];
  }
  // 0: the instance is not visited.
  static uint32_t seen_classes(const RayState& state, uint32_t index) {
    const InstanceNode& node = state.top_level->nodes()[index];
    if (state.ended || (node.mask & state.inclusion_mask) == 0) return 0;
    return state.classes[static_cast<uint32_t>(node.opacity)];
  }

  static bool intersect_one(RayState& state, uint32_t index, RTCRayHit& ray_hit) {
    RTCHit& hit = ray_hit.hit;
    // Each instance is visited once, so the hit has this index only if the hit is new.
    const auto hit_here = [&] { return hit.instID[0] == index; };
    if (const uint32_t classes = seen_classes(state, index)) {
      Visit()(state, index, classes, ray_hit.ray, hit.geomID != RTC_INVALID_GEOMETRY_ID, hit_here,
              [&](RTCScene scene) { shim::intersect(scene, state.query, &ray_hit); });
    }
    return hit_here();
  }
  static bool occlude_one(RayState& state, uint32_t index, RTCRay& ray) {
    const auto hit_here = [&] { return ray.tfar < 0; };
    if (const uint32_t classes = seen_classes(state, index)) {
      Visit()(state, index, classes, ray, false, hit_here,
              [&](RTCScene scene) { shim::occluded(scene, state.query, &ray); });
    }
    return hit_here();
  }
};

}  // namespace kaamos::embree
