// SPDX-License-Identifier: MIT
//
// TraceRay: check, traverse, then run the closest-hit or the miss shader. HitObject::TraceRay
// writes down what they would run for.
#include "runtime/embree/trace.h"

#include <cstring>

#include "runtime/embree/far_rays.h"
#include "runtime/embree/fault.h"
#include "runtime/embree/lane_rays.h"
#include "runtime/embree/ray_setup.h"

namespace kaamos::embree {
namespace {

using shader::TraceRayArguments;

// Returns whether only the existence of a hit matters. This includes forced-opaque rays without a
// closest-hit shader, as long as no intersection shader could see the difference.
bool asks_visibility(const RayState& state) {
  if ((state.ray_flags & kRaySkipClosestHitShader) == 0) return false;
  return (state.ray_flags & kRayAcceptFirstHitAndEndSearch) != 0 ||
         ((state.ray_flags & kRayForceOpaque) != 0 && !state.top_level->has_procedurals());
}

uint32_t committed_hit_kind(const InstanceNode& instance, const RTCRayHit& ray_hit) {
  alignas(16) float direction[4];
  _mm_store_ps(direction, to_object_vector(instance, _mm_load_ps(&ray_hit.ray.dir_x)));
  return triangle_hit_kind(instance, &ray_hit.hit.Ng_x, direction);
}

uint64_t record_of(const TraceRayArguments& arguments, const RayState& state,
                   const RTCRayHit& ray_hit, const InstanceNode& instance) {
  uint32_t geometry = ray_hit.hit.geomID;
  if (instance.clustered) [[unlikely]] {
    geometry =
        state.top_level->cluster_triangle(ray_hit.hit.instID[0], geometry, ray_hit.hit.primID)
            .geometry_index;
  }
  return hit_record_index(arguments.ray_contribution_to_hit_group_index,
                          arguments.multiplier_for_geometry_contribution, geometry,
                          instance.contribution);
}

// If a search was ended early, Embree's ray no longer has its t.
template <bool some_exact>
float hit_t(const RayState& state, const RTCRayHit& ray_hit) {
  return some_exact || state.ended ? state.committed_t : ray_hit.ray.tfar;
}

// `some_exact`: a bottom level of the top level is exact.
template <bool some_exact>
void run_closest_hit(Worker& worker, const shader::Invocation& caller,
                     const TraceRayArguments& arguments, RayState& state,
                     const RTCRayHit& ray_hit) {
  const uint32_t index = ray_hit.hit.instID[0];
  const InstanceNode& instance = state.top_level->nodes()[index];
  const ShaderRecord record =
      worker.dispatch->hit_table.at(record_of(arguments, state, ray_hit, instance));
  const Shader& shader = record.target->closest_hit;
  if (!shader.runs()) [[unlikely]]
    return;
  ++worker.counters.closest_hit_calls;

  const float t = hit_t<some_exact>(state, ray_hit);
  const void* attributes = state.procedural_attributes;
  uint32_t hit_kind = state.procedural_hit_kind;
  float barycentrics[2];
  if (!instance.procedural) [[likely]] {
    if (shader.reads_hit_kind) {
      hit_kind = some_exact && instance.exact ? state.exact->hit_kind
                                              : committed_hit_kind(instance, ray_hit);
    }
    barycentrics[0] = ray_hit.hit.u;
    barycentrics[1] = ray_hit.hit.v;
    clamp_barycentrics(barycentrics[0], barycentrics[1]);
    attributes = barycentrics;
  }
  set_hit_values(state, index, ray_hit.hit.geomID, ray_hit.hit.primID, hit_kind, t);
  shader::Invocation invocation = invocation_of(caller, shader, record, state.values);
  const RunningShader running(worker, shader);
  shader.as<shader::ClosestHitFn>()(invocation, state.payload, attributes);
}

void run_miss(Worker& worker, const shader::Invocation& caller, const TraceRayArguments& arguments,
              RayState& state) {
  ++worker.counters.misses;
  const uint32_t index = arguments.miss_shader_index & 0xFFFFu;
  const ShaderRecord record = worker.dispatch->miss_table.at(index);
  const Shader& shader = record.target->shader;
  if (!shader.runs()) [[unlikely]]
    return;
  ++worker.counters.miss_calls;
  state.values.t_current = state.values.ray.t_max;
  shader::Invocation invocation = invocation_of(caller, shader, record, state.values);
  const RunningShader running(worker, shader);
  shader.as<shader::MissFn>()(invocation, state.payload);
}

// What TraceRay does with what it finds.
struct RunShaders {
  static constexpr bool kWantsHit = false;  // with RAY_FLAG_SKIP_CLOSEST_HIT_SHADER

  template <bool some_exact>
  void hit(Worker& worker, const shader::Invocation& caller, const TraceRayArguments& arguments,
           RayState& state, const RTCRayHit& ray_hit) const {
    if ((state.ray_flags & kRaySkipClosestHitShader) != 0) return;
    run_closest_hit<some_exact>(worker, caller, arguments, state, ray_hit);
  }
  void miss(Worker& worker, const shader::Invocation& caller, const TraceRayArguments& arguments,
            RayState& state) const {
    run_miss(worker, caller, arguments, state);
  }
};

// What HitObject::TraceRay does with it.
struct WriteHitObject {
  static constexpr bool kWantsHit = true;

  template <bool some_exact>
  void hit(Worker&, const shader::Invocation&, const TraceRayArguments& arguments, RayState& state,
           const RTCRayHit& ray_hit) const {
    const uint32_t index = ray_hit.hit.instID[0];
    const InstanceNode& instance = state.top_level->nodes()[index];
    uint32_t hit_kind = state.procedural_hit_kind;
    if (instance.procedural) {
      std::memcpy(out.attributes, state.procedural_attributes, sizeof(out.attributes));
    } else {
      hit_kind = some_exact && instance.exact ? state.exact->hit_kind
                                              : committed_hit_kind(instance, ray_hit);
      float barycentrics[2] = {ray_hit.hit.u, ray_hit.hit.v};
      clamp_barycentrics(barycentrics[0], barycentrics[1]);
      std::memcpy(out.attributes, barycentrics, sizeof(barycentrics));
    }
    set_hit_values(state, index, ray_hit.hit.geomID, ray_hit.hit.primID, hit_kind,
                   hit_t<some_exact>(state, ray_hit));
    if (!instance.procedural) {
      shader::set_position_table(out, shader::table_at(state.values.world_to_object));
    }
    write(state.values, shader::kHitObjectHit);
    out.record = static_cast<uint32_t>(record_of(arguments, state, ray_hit, instance));
    out.instance_index = state.values.instance_index;
    out.instance_id = state.values.instance_id;
    out.geometry_index = state.values.geometry_index;
    out.primitive_index = state.values.primitive_index;
    out.hit_kind = hit_kind;
    std::memcpy(out.object_to_world, state.values.object_to_world, sizeof(out.object_to_world));
    std::memcpy(out.world_to_object, state.values.world_to_object, sizeof(out.world_to_object));
  }
  void miss(Worker& worker, const shader::Invocation&, const TraceRayArguments& arguments,
            RayState& state) const {
    ++worker.counters.misses;
    state.values.t_current = state.values.ray.t_max;
    write(state.values, shader::kHitObjectMiss);
    out.record = arguments.miss_shader_index & 0xFFFFu;
  }
  void write(const shader::RaySystemValues& values, uint32_t hit_state) const {
    out.state = hit_state;
    out.ray_flags = values.ray_flags;
    std::memcpy(out.origin, values.ray.origin, sizeof(out.origin));
    out.t_min = values.ray.t_min;
    std::memcpy(out.direction, values.ray.direction, sizeof(out.direction));
    out.t = values.t_current;
    out.is_bound = 1;
  }

  shader::HitObject& out;
};

// Traversals from the top level on, and from known box entries on.
struct WholeTraversal {
  void intersect(RayState& state, RTCRayHit& ray_hit) const { embree::intersect(state, ray_hit); }
  void occlude(RayState& state, RTCRay& ray) const { embree::occlude(state, ray); }
};
template <bool some_exact>
struct LaneTraversal {
  void intersect(RayState& state, RTCRayHit& ray_hit) const {
    if (some_exact) return intersect_exactly(state, ray_hit, lanes, lane);
    embree::intersect(state, ray_hit, lanes, lane);
  }
  void occlude(RayState& state, RTCRay& ray) const {
    if (some_exact) return occlude_exactly(state, ray, lanes, lane);
    embree::occlude(state, ray, lanes, lane);
  }

  const LaneSearches& lanes;
  int lane;
};

// Traverses, and passes on what was found.
template <bool some_exact, typename Traversal, typename End>
void search(Worker& worker, const shader::Invocation& caller, const TraceRayArguments& arguments,
            RayState& state, RTCRayHit& ray_hit, Traversal traversal, End end) {
  if (!End::kWantsHit && asks_visibility(state)) {
    ++worker.counters.visibility_rays;
    traversal.occlude(state, ray_hit.ray);
    if (ray_hit.ray.tfar >= 0) end.miss(worker, caller, arguments, state);
    return;
  }
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  traversal.intersect(state, ray_hit);
  if (ray_hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return end.miss(worker, caller, arguments, state);
  }
  end.template hit<some_exact>(worker, caller, arguments, state, ray_hit);
}

// Out of line, because it needs much stack and few scenes get here.
template <typename End>
[[gnu::noinline]] void search_exactly(Worker& worker, const shader::Invocation& caller,
                                      const TraceRayArguments& arguments, RayState& state,
                                      const ObjectRay& world, End end) {
  RTCRayHit ray_hit;
  ExactState exact;
  if (!begin_exact_ray(state, exact, world, ray_hit.ray))
    return end.miss(worker, caller, arguments, state);
  search<true>(worker, caller, arguments, state, ray_hit, WholeTraversal(), end);
}

// With fewer than three rays it does not pay to test them against the boxes together.
bool are_three(uint32_t lanes) {
  const uint32_t others = lanes & (lanes - 1);
  return (others & (others - 1)) != 0;
}

// The rest of trace_rays, for rays that can test the boxes of `top_level` together.
template <bool some_exact>
void trace_together(Worker& worker, shader::Invocation& caller, const TraceRayArguments& arguments,
                    void* payloads, const shader::LaneRays& rays, uint32_t lanes,
                    const TopLevel& top_level) {
  check_depth(worker, caller);
  LaneSearches searches;
  search_lanes(rays, top_level.boxes(), searches);
  RayState state;
  [[maybe_unused]] ExactState exact;
  state.worker = &worker;
  state.arguments = &arguments;
  state.caller = &caller;
  state.values.ray_flags = arguments.ray_flags & kAllRayFlags;
  begin_searches(state, state.values.ray_flags | worker.dispatch->pipeline_flags,
                 arguments.instance_inclusion_mask, &top_level);
  trace_each(
      caller, arguments, payloads, rays, lanes,
      [&](int lane, void* payload, shader::RayLanes origin, shader::RayLanes direction) {
        ++worker.counters.rays;
        state.payload = payload;
        _mm_store_ps(state.values.ray.origin, origin);
        _mm_store_ps(state.values.ray.direction, direction);
        const ObjectRay world = {without_fourth_lane(origin), without_fourth_lane(direction)};
        if ((searches.valid >> lane & 1) == 0) [[unlikely]] {
          note_far_ray(worker, world, origin[3], direction[3]);
          return run_miss(worker, caller, arguments, state);
        }
        begin_search(state, origin[3], direction[3], searches.t_near[lane], searches.t_far[lane]);
        RTCRayHit ray_hit;
        if constexpr (some_exact) {
          begin_exact_ray(state, exact, world, ray_hit.ray);
        } else {
          begin_embree_ray(state, world, ray_hit.ray);
        }
        search<some_exact>(worker, caller, arguments, state, ray_hit,
                           LaneTraversal<some_exact>{searches, lane}, RunShaders());
      });
}

template <typename End>
[[gnu::always_inline]] inline void trace(shader::Invocation& caller,
                                         const TraceRayArguments& arguments, void* payload,
                                         shader::RayLanes origin_t_min,
                                         shader::RayLanes direction_t_max, End end) {
  Worker& worker = worker_of(caller);
  check_depth(worker, caller);
  ++worker.counters.rays;
  RayState state;
  state.worker = &worker;
  state.arguments = &arguments;
  state.caller = &caller;
  state.payload = payload;
  const TopLevel* top_level = find_top_level(worker, arguments.acceleration_structure);
  _mm_store_ps(state.values.ray.origin, origin_t_min);
  _mm_store_ps(state.values.ray.direction, direction_t_max);
  state.values.ray_flags = arguments.ray_flags & kAllRayFlags;
  const ObjectRay world = {without_fourth_lane(origin_t_min), without_fourth_lane(direction_t_max)};
  const float t_min = origin_t_min[3];
  const float t_max = direction_t_max[3];
  if (top_level == nullptr || top_level->empty() || !is_valid(world, t_min, t_max)) [[unlikely]] {
    if (top_level != nullptr && !top_level->empty()) note_far_ray(worker, world, t_min, t_max);
    return end.miss(worker, caller, arguments, state);
  }
  if (makes_non_opaque(arguments.ray_flags)) [[unlikely]] {
    top_level = &top_level->for_non_opaque();
  }
  begin_search(state, state.values.ray_flags | worker.dispatch->pipeline_flags,
               arguments.instance_inclusion_mask, top_level, t_min, t_max);
  if (top_level->has_exact()) [[unlikely]] {
    return search_exactly(worker, caller, arguments, state, world, end);
  }
  RTCRayHit ray_hit;
  begin_embree_ray(state, world, ray_hit.ray);
  search<false>(worker, caller, arguments, state, ray_hit, WholeTraversal(), end);
}

}  // namespace

void check_depth(Worker& worker, const shader::Invocation& caller) {
  check_stack(worker);
  // Ray generation is depth 0; TraceRay at the declared depth removes the device. [DXR: Ray
  // recursion limit]
  if (caller.depth >= worker.dispatch->max_recursion_depth) [[unlikely]] {
    remove_device(worker, shader::RemovalReason::kRecursionDepth);
  }
}

void trace_ray(shader::Invocation& caller, const TraceRayArguments& arguments, void* payload,
               shader::RayLanes origin_t_min, shader::RayLanes direction_t_max) {
  trace(caller, arguments, payload, origin_t_min, direction_t_max, RunShaders());
}

void trace_hit_object(shader::Invocation& caller, const TraceRayArguments& arguments, void* payload,
                      shader::RayLanes origin_t_min, shader::RayLanes direction_t_max,
                      shader::HitObject& hit) {
  trace(caller, arguments, payload, origin_t_min, direction_t_max, WriteHitObject{hit});
}

void trace_rays(shader::Invocation& caller, const TraceRayArguments& arguments, void* payloads,
                const shader::LaneRays& rays, uint32_t lanes) {
  Worker& worker = worker_of(caller);
  const TopLevel* top_level = find_top_level(worker, arguments.acceleration_structure);
  const bool together = caller.depth == 0 && are_three(lanes) && top_level != nullptr &&
                        !top_level->boxes().empty() && !top_level->has_procedurals();
  if (together) {
    // Kept alive in the worker and not on this stack, since a fault would leave the stack without
    // releasing it; that is why it works at one depth only.
    if (worker.shared_top_level.get() != top_level) {
      worker.shared_top_level = worker.cached_top_level;
    }
    if (makes_non_opaque(arguments.ray_flags)) [[unlikely]] {
      top_level = &top_level->for_non_opaque();
    }
    const auto trace = top_level->has_exact() ? trace_together<true> : trace_together<false>;
    return trace(worker, caller, arguments, payloads, rays, lanes, *top_level);
  }
  trace_each(caller, arguments, payloads, rays, lanes,
             [&](int, void* payload, shader::RayLanes origin, shader::RayLanes direction) {
               trace_ray(caller, arguments, payload, origin, direction);
             });
}

}  // namespace kaamos::embree
