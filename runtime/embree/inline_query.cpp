// SPDX-License-Identifier: MIT
#include "runtime/embree/inline_query.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "kaamos/shader/ray_query.h"
#include "runtime/embree/far_rays.h"
#include "runtime/embree/ray_setup.h"

namespace kaamos::embree {
namespace {

using shader::RayQuery;
using shader::RayQueryFound;
using shader::RayQueryHit;

constexpr float kNone = std::numeric_limits<float>::infinity();

auto key_of(const RayQueryFound& found) {
  return std::tie(found.t, found.instance, found.geometry, found.primitive);
}

RayQueryHit hit_of(const TopLevel& scene, const RayQueryFound& found, uint32_t type) {
  const InstanceNode& node = scene.nodes()[found.instance];
  RayQueryHit hit;
  hit.type = type;
  hit.t = found.t;
  hit.instance_index = found.instance;
  hit.instance_id = scene.instance_id(found.instance);
  hit.instance_contribution = node.contribution;
  hit.geometry_index = found.geometry;
  hit.primitive_index = found.primitive;
  hit.barycentrics[0] = found.barycentrics[0];
  hit.barycentrics[1] = found.barycentrics[1];
  hit.front_face = found.front_face;
  hit.non_opaque = found.procedural && found.non_opaque;
  hit.object_to_world = node.object_to_world;
  hit.world_to_object = scene.world_to_object(found.instance);
  if (node.clustered) [[unlikely]] {
    hit.cluster = &scene.cluster_triangle(found.instance, found.geometry, found.primitive);
    hit.geometry_index = hit.cluster->geometry_index;
    hit.primitive_index = hit.cluster->primitive_index;
  }
  return hit;
}

RayQueryFound triangle_of(const RTCHit& hit, float t, uint32_t instance, uint32_t geometry,
                          bool front_face) {
  RayQueryFound found = {t,     instance, geometry,  hit.primID, {hit.u, hit.v},
                         false, true,     front_face};
  clamp_barycentrics(found.barycentrics[0], found.barycentrics[1]);
  return found;
}

// Returns where the ray enters the box, reduced by what rounding may add. If the direction is 0
// along an axis, the comparisons are false and the axis is ignored.
float entry_of(const rtapi::RaytracingAabb& box, const RTCRay& ray, float t_min) {
  const float low[3] = {box.MinX, box.MinY, box.MinZ};
  const float high[3] = {box.MaxX, box.MaxY, box.MaxZ};
  const float origin[3] = {ray.org_x, ray.org_y, ray.org_z};
  const float direction[3] = {ray.dir_x, ray.dir_y, ray.dir_z};
  float entry = t_min;
  for (int axis = 0; axis < 3; ++axis) {
    const float a = (low[axis] - origin[axis]) / direction[axis];
    const float b = (high[axis] - origin[axis]) / direction[axis];
    const float near = a < b ? a : b;
    if (near > entry && near < kNone) entry = near;
  }
  return std::max(t_min, entry * (1.0f - 16 * FLT_EPSILON));
}

void commit_opaque(RayQuery& query, const TopLevel& scene, const RayQueryFound& found) {
  query.committed = hit_of(scene, found, shader::kCommittedTriangle);
  if ((query.ray_flags & kRayAcceptFirstHitAndEndSearch) != 0) query.ended = true;
}

// Takes what Embree committed by itself, in a first search without `any`.
void take_embree_hit(RayState& state, const RTCRayHit& ray_hit, QuerySearch& search) {
  if (ray_hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
  const uint32_t index = ray_hit.hit.instID[0];
  const InstanceNode& instance = state.top_level->nodes()[index];
  if (instance.exact) {
    search.opaque = triangle_of(ray_hit.hit, state.committed_t, index, ray_hit.hit.geomID,
                                state.exact->hit_kind == kHitKindTriangleFrontFace);
    search.has_opaque = true;
    return;
  }
  alignas(16) float direction[4];
  _mm_store_ps(direction, to_object_vector(instance, _mm_load_ps(&ray_hit.ray.dir_x)));
  const bool front =
      triangle_hit_kind(instance, &ray_hit.hit.Ng_x, direction) == kHitKindTriangleFrontFace;
  const float t = state.top_level->has_exact() ? state.committed_t : ray_hit.ray.tfar;
  search.opaque = triangle_of(ray_hit.hit, t, index, ray_hit.hit.geomID, front);
  search.has_opaque = true;
}

void search(Worker& worker, RayQuery& query) {
  check_stack(worker);
  const auto& scene = *static_cast<const TopLevel*>(query.scene);
  RayState state;
  state.worker = &worker;
  state.values.ray = query.ray;
  const bool first = !query.searched;
  begin_search(state, query.ray_flags | (query.inclusion_mask & kRayAllowsMicromaps),
               query.inclusion_mask, &scene, query.ray.t_min, query.ray.t_max);
  QuerySearch search = {
      query, first, first && (query.ray_flags & kRayAcceptFirstHitAndEndSearch) != 0,
      {},    false, {}};
  if (!first) {
    // `found` is used up; its last entry was the farthest that the shader has seen.
    search.shown = query.found[query.count - 1];
    state.t_far = std::min(state.t_far, query.committed.t);
    state.t_max = std::min(state.t_max, query.committed.t);
  }
  state.search = &search;
  query.searched = true;
  query.next = query.count = 0;
  query.next_left_out = kNone;

  const ObjectRay world = {without_fourth_lane(_mm_load_ps(state.values.ray.origin)),
                           without_fourth_lane(_mm_load_ps(state.values.ray.direction))};
  RTCRayHit ray_hit;
  ExactState exact;
  if (!scene.has_exact()) {
    begin_embree_ray(state, world, ray_hit.ray);
  } else if (!begin_exact_ray(state, exact, world, ray_hit.ray)) {
    return;
  }
  if (search.any) {
    occlude(state, ray_hit.ray);
  } else {
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(state, ray_hit);
    if (first) take_embree_hit(state, ray_hit, search);
  }
  if (search.has_opaque) commit_opaque(query, scene, search.opaque);
}

// Returns whether a hit committed in the meantime rules the candidate out.
bool is_beyond(const RayQuery& query, const RayQueryFound& found) {
  return found.procedural ? found.t > query.committed.t : found.t >= query.committed.t;
}

}  // namespace

void QuerySearch::offer(const RayQueryFound& found) {
  if (!first && key_of(found) <= key_of(shown)) return;
  RayQueryFound* const begin = query.found;
  RayQueryFound* const end = begin + query.count;
  RayQueryFound* const at = std::lower_bound(
      begin, end, found,
      [](const RayQueryFound& a, const RayQueryFound& b) { return key_of(a) < key_of(b); });
  if (at != end && key_of(*at) == key_of(found)) return;
  if (query.count == RayQuery::kChunk) {
    const float left_out = at == end ? found.t : end[-1].t;
    query.next_left_out = std::min(query.next_left_out, left_out);
    if (at == end) return;
    std::move_backward(at, end - 1, end);
  } else {
    std::move_backward(at, end, end + 1);
    ++query.count;
  }
  *at = found;
}

bool QuerySearch::take_triangle(RayState& state, const GeometryInfo& geometry, RTCRay& ray,
                                const RTCHit& hit, bool is_opaque, bool front_face) {
  const auto instance = static_cast<uint32_t>(state.instance - state.top_level->nodes());
  const RayQueryFound found = triangle_of(hit, ray.tfar, instance, geometry.slot, front_face);
  if (is_opaque) {
    if (!any) {
      state.committed_t = ray.tfar;
      return true;
    }
    opaque = found;
    has_opaque = true;
    state.ended = true;
    ray.tfar = shim::kEndedSearch;
    return true;
  }
  offer(found);
  // With a full buffer this search ignores everything farther, except that the first search still
  // looks for opaque triangles.
  if (first || query.count < RayQuery::kChunk) return false;
  const float farthest = query.found[query.count - 1].t;
  query.next_left_out = std::min(query.next_left_out, farthest);  // not visited any more
  // One ulp farther, because the next instance's ray ends just before what is committed.
  ray.tfar = std::min(state.t_far, next_above(farthest));
  state.t_far = ray.tfar;
  return true;
}

void QuerySearch::take_box(const RayState& state, const GeometryInfo& geometry, uint32_t primitive,
                           const RTCRay& ray) {
  const auto instance = static_cast<uint32_t>(state.instance - state.top_level->nodes());
  RayQueryFound found = {};
  found.t = entry_of(geometry.boxes[primitive], ray, state.t_min);
  found.instance = instance;
  found.geometry = geometry.index;
  found.primitive = primitive;
  found.procedural = true;
  found.non_opaque = !is_opaque(state, geometry.opaque);
  offer(found);
}

void begin_query(shader::Invocation& caller, RayQuery& query,
                 const shader::RayQueryArguments& arguments, const shader::RayDesc& ray) {
  Worker& worker = worker_of(caller);
  const TopLevel* scene = find_top_level(worker, arguments.acceleration_structure);
  if (scene != nullptr && makes_non_opaque(arguments.ray_flags)) [[unlikely]] {
    scene = &scene->for_non_opaque();
  }
  query.ray = ray;
  query.ray_flags = arguments.ray_flags & kAllRayFlags;
  // The mask has 8 bits; the permission of micromaps is one of the others.
  query.inclusion_mask =
      arguments.instance_inclusion_mask | (arguments.ray_flags & kRayAllowsMicromaps);
  query.has_candidate = false;
  query.candidate = {};
  query.committed = {};
  query.committed.t = ray.t_max;
  query.scene = scene;
  query.searched = false;
  query.next = query.count = 0;
  query.next_left_out = kNone;
  const ObjectRay world = {_mm_setr_ps(ray.origin[0], ray.origin[1], ray.origin[2], 0),
                           _mm_setr_ps(ray.direction[0], ray.direction[1], ray.direction[2], 0)};
  query.ended = scene == nullptr || scene->empty();
  if (!query.ended && !is_valid(world, ray.t_min, ray.t_max)) [[unlikely]] {
    note_far_ray(worker, world, ray.t_min, ray.t_max);
    query.ended = true;
  }
}

bool proceed(shader::Invocation& caller, RayQuery& query) {
  Worker& worker = worker_of(caller);
  if (!query.searched) search(worker, query);
  while (!query.ended) {
    while (query.next < query.count) {
      const RayQueryFound& found = query.found[query.next++];
      if (is_beyond(query, found)) continue;
      query.candidate =
          hit_of(*static_cast<const TopLevel*>(query.scene), found,
                 found.procedural ? shader::kQueryProcedural : shader::kQueryTriangle);
      if (found.procedural) query.candidate.t = 0;  // the shader decides where it is hit
      return true;
    }
    // The search was the last if it left nothing out, or nothing within reach.
    if (!(query.next_left_out <= query.committed.t)) return false;
    search(worker, query);
  }
  return false;
}

}  // namespace kaamos::embree
