// SPDX-License-Identifier: MIT
//
// Traversal of top levels some or all of whose bottom levels are exact: what a ray does at an
// instance, and the callback for triangles, whose tests come in DXR's order, as in any_hit.cpp.
#include <algorithm>
#include <bit>
#include <tuple>

#include "runtime/embree/any_hit.h"
#include "runtime/embree/exact.h"
#include "runtime/embree/far_rays.h"
#include "runtime/embree/inline_query.h"
#include "runtime/embree/instance_level.h"
#include "runtime/embree/lane_rays.h"
#include "runtime/embree/parallel.h"

namespace kaamos::embree {
namespace {

// A pack whose box the ray hits. `primitive` and `barycentrics` are those of the triangle being
// tested, and at the end those of the last one that was accepted.
struct PackOffer {
  RayState& state;
  const GeometryInfo& geometry;
  const TrianglePack& pack;
  uint32_t primitive;
  float barycentrics[2];

  bool is_culled(uint32_t hit_kind) const {
    if ((state.instance->flags & kInstanceTriangleCullDisable) != 0) return false;
    const uint32_t culled_by = hit_kind == kHitKindTriangleBackFace ? kRayCullBackFacingTriangles
                                                                    : kRayCullFrontFacingTriangles;
    return (state.ray_flags & culled_by) != 0;
  }

  // Among opaque triangles at the same t, the first by instance, geometry and primitive is the hit,
  // in whatever order the traversal finds them. A triangle that an any-hit shader accepted stays,
  // because one that is found after it is outside the open interval. [DXR: Ray extents]
  bool wins_tie(bool opaque) const {
    const ExactState& exact = *state.exact;
    if (!opaque || !exact.hit_opaque) return false;
    const auto index = static_cast<uint32_t>(state.instance - state.top_level->nodes());
    return std::tie(index, geometry.slot, primitive) <
           std::tie(exact.instance, exact.geometry, exact.primitive);
  }

  void commit(float t, uint32_t hit_kind, bool opaque, bool end_search) const {
    ExactState& exact = *state.exact;
    state.committed_t = t;
    state.ended = end_search || (state.ray_flags & kRayAcceptFirstHitAndEndSearch) != 0;
    exact.hit_kind = hit_kind;
    exact.instance = static_cast<uint32_t>(state.instance - state.top_level->nodes());
    exact.geometry = geometry.slot;
    exact.primitive = primitive;
    exact.hit_opaque = opaque;
  }

  // For an inline query, which visits all of its candidates and keeps the nearest ones itself.
  bool take_for_query(float t, uint32_t hit_kind, bool opaque) const {
    if (t == state.committed_t && !wins_tie(opaque)) return false;
    QuerySearch& search = *state.search;
    const auto instance = static_cast<uint32_t>(state.instance - state.top_level->nodes());
    const shader::RayQueryFound found = {t,
                                         instance,
                                         geometry.slot,
                                         primitive,
                                         {barycentrics[0], barycentrics[1]},
                                         false,
                                         true,
                                         hit_kind == kHitKindTriangleFrontFace};
    if (!opaque) return search.offer(found), false;
    commit(t, hit_kind, true, search.any);
    if (search.any) {
      search.opaque = found;
      search.has_opaque = true;
    }
    return true;
  }

  // For a triangle that is linked to micromaps. An opaque one counts as accepted by an any-hit
  // shader, so that of triangles at the same t the same one is hit as without micromaps.
  [[gnu::noinline]] bool accept_linked(float t, uint32_t hit_kind) {
    const auto found =
        micromap_opacity(state, geometry, primitive, barycentrics[0], barycentrics[1]);
    if (found == runtime::Opacity::kTransparent) return false;
    const bool opaque = found == runtime::Opacity::kOpaque;
    if (state.search != nullptr) return take_for_query(t, hit_kind, opaque);
    if (t == state.committed_t) return false;
    if (opaque) return commit(t, hit_kind, false, false), true;
    const ShaderRecord record = hit_record(state, *state.instance, geometry.index);
    if (!record.target->any_hit.runs()) return commit(t, hit_kind, false, false), true;
    const Candidate candidate = {t, hit_kind, geometry.slot, primitive, barycentrics};
    const auto result = run_any_hit(state, record, candidate);
    if (result == shader::AnyHitResult::kIgnore) return false;
    commit(t, hit_kind, false, result == shader::AnyHitResult::kAcceptAndEndSearch);
    return true;
  }

  bool accept_any() {
    uint32_t open = state.exact->filter(state.exact->object, pack);
    bool accepted = false;
    uint32_t last = 0;
    float weights[2];
    for (; open != 0 && !state.ended; open &= open - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(open));
      if (!accept(lane)) continue;
      accepted = true;
      last = primitive;
      std::copy(barycentrics, barycentrics + 2, weights);
    }
    if (!accepted) return false;
    primitive = last;
    std::copy(weights, weights + 2, barycentrics);
    return true;
  }

  bool accept(uint32_t lane) {
    float a[3], b[3], c[3];
    pack.corner_of(lane, 0, a);
    pack.corner_of(lane, 1, b);
    pack.corner_of(lane, 2, c);
    ExactHit hit;
    if (!intersect(state.exact->object, a, b, c, hit)) return false;
    primitive = pack.primitives[lane];
    const auto t = static_cast<float>(state.exact->object_start_t + hit.t);
    if (!(t > state.t_min && t < state.t_max && t <= state.committed_t)) return false;
    const bool flipped = (state.instance->flags & kInstanceTriangleFrontCounterclockwise) != 0;
    const uint32_t hit_kind =
        hit.clockwise != flipped ? kHitKindTriangleFrontFace : kHitKindTriangleBackFace;
    if (is_culled(hit_kind)) return false;
    barycentrics[0] = static_cast<float>(hit.u);
    barycentrics[1] = static_cast<float>(hit.v);
    clamp_barycentrics(barycentrics[0], barycentrics[1]);

    if (geometry.linkage != nullptr) return accept_linked(t, hit_kind);
    bool opaque = is_opaque(state, geometry.opaque);
    if (state.search != nullptr) return take_for_query(t, hit_kind, opaque);
    ShaderRecord record;
    if (!opaque) {
      record = hit_record(state, *state.instance, geometry.index);
      // Without an any-hit shader the geometry is opaque. [DXR: TraceRay control flow, note 3]
      opaque = !record.target->any_hit.runs();
    }
    if (t == state.committed_t && !wins_tie(opaque)) return false;
    if (opaque) return commit(t, hit_kind, true, false), true;
    const Candidate candidate = {t, hit_kind, geometry.slot, primitive, barycentrics};
    const auto result = run_any_hit(state, record, candidate);
    if (result == shader::AnyHitResult::kIgnore) return false;
    commit(t, hit_kind, false, result == shader::AnyHitResult::kAcceptAndEndSearch);
    return true;
  }
};

// The following give Embree the ray for a bottom level. False: it cannot hit anything there.
bool enter_exact(RayState& state, uint32_t index, RTCRay& ray) {
  ExactState& exact = *state.exact;
  const ExactInstance& instance = state.top_level->exact_instance(index);
  RayInDouble object = to_object_space(instance, in_double(state.values.ray));
  EmbreeRay& local = exact.in_bottom_level;
  if (!local.set(object, *instance.frame)) return false;
  if (local.start_t != 0) {
    for (int i = 0; i < 3; ++i) object.origin[i] += local.start_t * object.direction[i];
  }
  exact.object = ExactRay(object.origin, object.direction);
  exact.object_start_t = local.start_t;
  const float t_near = local.near_of(state.t_min);
  const float t_far = local.far_of(std::min(state.t_max, state.committed_t));
  _mm_store_ps(&ray.org_x, _mm_setr_ps(local.origin[0], local.origin[1], local.origin[2], t_near));
  _mm_store_ps(&ray.dir_x, _mm_setr_ps(local.direction[0], local.direction[1], local.direction[2],
                                       0));  // time
  ray.tfar = t_far;
  return t_near <= t_far;
}

// Boxes have no exact form: intersection shaders get the same ray in every precision.
bool enter_boxes(RayState& state, uint32_t index, bool committed, RTCRay& ray) {
  const InstanceNode& node = state.top_level->nodes()[index];
  const ObjectRay object =
      to_object_space(node, without_fourth_lane(_mm_load_ps(state.values.ray.origin)),
                      without_fourth_lane(_mm_load_ps(state.values.ray.direction)));
  if (!is_traceable(object)) return note_far_ray(state, index), false;
  _mm_store_ps(&ray.org_x, with_fourth_lane(object.origin, state.t_min));
  _mm_store_ps(&ray.dir_x, object.direction);
  ray.tfar = committed ? state.committed_t : state.t_max;
  return true;
}

// Those of the other bottom levels are Embree's.
bool enter_robust(RayState& state, uint32_t index, RTCRay& ray) {
  const InstanceNode& node = state.top_level->nodes()[index];
  const ObjectRay object =
      to_object_space(node, without_fourth_lane(_mm_load_ps(state.values.ray.origin)),
                      without_fourth_lane(_mm_load_ps(state.values.ray.direction)));
  if (!is_traceable(object)) return note_far_ray(state, index), false;
  _mm_store_ps(&ray.org_x, with_fourth_lane(object.origin, state.t_near));
  _mm_store_ps(&ray.dir_x, object.direction);
  ray.tfar = std::min(state.t_far, next_below(state.committed_t));
  return ray.tfar >= state.t_near;
}

// Returns whether a hit of Embree's only keeps a later search of a RayQuery short.
bool is_limit(const RayState& state) {
  return state.search != nullptr && !state.search->first;
}

// Returns where the ray ends for the boxes of a list. Coincident triangles must all be found, so it
// is a little behind the hit.
float end_among_boxes(float committed_t) {
  return committed_t * (1 + 8 * FLT_EPSILON);
}

// `in_tree`: the top level is an Embree scene, in whose coordinates the ray is between visits;
// otherwise it is in the world's.
template <bool in_tree>
struct Visit {
  template <typename HitHere, typename Trace>
  void operator()(RayState& state, uint32_t index, uint32_t classes, RTCRay& ray, bool committed,
                  HitHere hit_here, Trace trace) const {
    const InstanceNode& node = state.top_level->nodes()[index];
    const __m128 origin = _mm_load_ps(&ray.org_x);     // w: tnear
    const __m128 direction = _mm_load_ps(&ray.dir_x);  // w: time
    const float t_far = ray.tfar;
    const bool robust = !node.exact && !node.procedural;
    const bool entered = robust       ? enter_robust(state, index, ray)
                         : node.exact ? enter_exact(state, index, ray)
                                      : enter_boxes(state, index, committed, ray);
    if (entered) {
      ray.mask = classes;
      state.instance = &node;
      shim::set_instance(state.query, index);
      if (robust) select_filter(state, node);
      trace(node.scene);
      ray.mask = kAllClasses;
      shim::set_instance(state.query, RTC_INVALID_GEOMETRY_ID);
    }
    _mm_store_ps(&ray.org_x, origin);
    _mm_store_ps(&ray.dir_x, direction);
    if (entered && ray.tfar < 0) return;  // the search is over
    if (!entered || !hit_here() || (robust && is_limit(state))) {
      ray.tfar = t_far;
      return;
    }
    if (robust) state.committed_t = ray.tfar;
    if (!node.exact) state.exact->hit_opaque = false;
    ray.tfar = in_tree ? state.exact->in_top_level.far_of(state.committed_t)
                       : end_among_boxes(state.committed_t);
  }
};

using ListedInstances = InstanceLevel<Visit<false>>;
using TreeInstances = InstanceLevel<Visit<true>>;

}  // namespace

void bounds_of_exact_pack(const RTCBoundsFunctionArguments* arguments) {
  const BuilderCallback callback;
  const auto& info = *static_cast<const GeometryInfo*>(arguments->geometryUserPtr);
  const TrianglePack& pack = info.exact->packs[arguments->primID];
  double lower[3];
  double upper[3];
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = upper[axis] = pack.corners[0][axis][0];
    for (const auto& corner : pack.corners) {
      const auto [low, high] = std::minmax_element(corner[axis], corner[axis] + pack.count);
      lower[axis] = std::min(lower[axis], double{*low});
      upper[axis] = std::max(upper[axis], double{*high});
    }
  }
  *arguments->bounds_o = info.exact->frame->padded(lower, upper);
}

void intersect_exact_pack(const RTCIntersectFunctionNArguments* arguments) {
  RayState& state = ray_state_of(arguments->context);
  const auto& geometry = *static_cast<const GeometryInfo*>(arguments->geometryUserPtr);
  PackOffer offer = {state, geometry, geometry.exact->packs[arguments->primID], 0, {}};
  const bool hit = !state.ended && offer.accept_any();
  shim::set_hit(arguments, hit);
  if (!hit) return;
  auto* ray_hit = reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  ray_hit->ray.tfar =
      state.ended ? shim::kEndedSearch : state.exact->in_bottom_level.far_of(state.committed_t);
  ray_hit->hit.u = offer.barycentrics[0];
  ray_hit->hit.v = offer.barycentrics[1];
  ray_hit->hit.primID = offer.primitive;
  ray_hit->hit.geomID = offer.geometry.slot;
  ray_hit->hit.instID[0] = state.exact->instance;
}

void occlude_exact_pack(const RTCOccludedFunctionNArguments* arguments) {
  RayState& state = ray_state_of(arguments->context);
  const auto& geometry = *static_cast<const GeometryInfo*>(arguments->geometryUserPtr);
  PackOffer offer = {state, geometry, geometry.exact->packs[arguments->primID], 0, {}};
  const bool hit = !state.ended && offer.accept_any();
  shim::set_hit(arguments, hit);
  if (hit) reinterpret_cast<RTCRay*>(arguments->ray)->tfar = shim::kEndedSearch;
}

void intersect_exact_instance(const RTCIntersectFunctionNArguments* arguments) {
  TreeInstances::intersect(arguments);
}

void occlude_exact_instance(const RTCOccludedFunctionNArguments* arguments) {
  TreeInstances::occlude(arguments);
}

void intersect_exact_member(const RTCIntersectFunctionNArguments* arguments) {
  TreeInstances::intersect_member(arguments);
}

void occlude_exact_member(const RTCOccludedFunctionNArguments* arguments) {
  TreeInstances::occlude_member(arguments);
}

void intersect_exactly(RayState& state, RTCRayHit& ray_hit) {
  ListedInstances::intersect(state, ray_hit);
}

void occlude_exactly(RayState& state, RTCRay& ray) {
  ListedInstances::occlude(state, ray);
}

void intersect_exactly(RayState& state, RTCRayHit& ray_hit, const LaneSearches& lanes, int lane) {
  ListedInstances::intersect(state, ray_hit, lanes.entered[lane], lanes.entries_of(lane));
}

void occlude_exactly(RayState& state, RTCRay& ray, const LaneSearches& lanes, int lane) {
  ListedInstances::occlude(state, ray, lanes.entered[lane], lanes.entries_of(lane));
}

}  // namespace kaamos::embree
