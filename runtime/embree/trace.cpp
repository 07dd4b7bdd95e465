// SPDX-License-Identifier: MIT
//
// TraceRay: guard, traverse, then run the closest-hit or the miss shader.
#include "runtime/embree/trace.h"

#include "runtime/embree/fault.h"
#include "runtime/embree/ray_setup.h"

namespace kaamos::embree {
namespace {

using shader::TraceRayArguments;

// Whether only the existence of a hit counts. Forced-opaque rays without a closest-hit shader are
// such rays too, as long as no intersection shader could see the difference.
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

void run_closest_hit(RayState& state, const RTCRayHit& ray_hit) {
  const uint32_t index = ray_hit.hit.instID[0];
  const InstanceNode& instance = state.top_level->nodes()[index];
  const ShaderRecord record = hit_record(state, instance, ray_hit.hit.geomID);
  if (record.target->closest_hit == nullptr) [[unlikely]]
    return;
  const Shader& shader = *record.target->closest_hit;
  ++state.worker->counters.closest_hit_calls;

  // A search that was ended early has lost its t in Embree's ray.
  const bool exact = state.top_level->exact_frame() != nullptr;
  const float t = state.ended || exact ? state.committed_t : ray_hit.ray.tfar;
  const void* attributes = state.procedural_attributes;
  uint32_t hit_kind = state.procedural_hit_kind;
  float barycentrics[2];
  if (!instance.procedural) [[likely]] {
    if (shader.reads_hit_kind) {
      hit_kind = exact ? state.exact->hit_kind : committed_hit_kind(instance, ray_hit);
    }
    barycentrics[0] = ray_hit.hit.u;
    barycentrics[1] = ray_hit.hit.v;
    clamp_barycentrics(barycentrics[0], barycentrics[1]);
    attributes = barycentrics;
  }
  RayInvocation invocation(
      state, shader, record,
      hit_values(state, index, ray_hit.hit.geomID, ray_hit.hit.primID, hit_kind, t));
  const RunningShader running(*state.worker, shader);
  shader.as<shader::ClosestHitFn>()(invocation, state.payload, attributes);
}

void run_miss(RayState& state) {
  ++state.worker->counters.misses;
  const uint32_t index = state.arguments->miss_shader_index & 0xFFFFu;
  const ShaderRecord record = state.worker->dispatch->miss_table.at(index);
  if (record.target->shader == nullptr) [[unlikely]]
    return;
  const Shader& shader = *record.target->shader;
  ++state.worker->counters.miss_calls;
  RayInvocation invocation(state, shader, record, ray_values(state, state.ray.t_max));
  const RunningShader running(*state.worker, shader);
  shader.as<shader::MissFn>()(invocation, state.payload);
}

}  // namespace

void trace_ray(shader::Invocation& caller, const TraceRayArguments& arguments, void* payload,
               shader::RayLanes origin_t_min, shader::RayLanes direction_t_max) {
  Worker& worker = worker_of(caller);
  check_stack(worker);
  // Ray generation is depth 0; at the declared depth TraceRay removes the device.
  // [DXR: Ray recursion limit]
  if (caller.depth >= worker.dispatch->max_recursion_depth) [[unlikely]] {
    remove_device(worker, shader::RemovalReason::kRecursionDepth);
  }
  ++worker.counters.rays;
  RayState state;
  state.worker = &worker;
  state.arguments = &arguments;
  state.caller = &caller;
  state.payload = payload;
  const TopLevel* top_level = find_top_level(worker, arguments.acceleration_structure);
  _mm_store_ps(state.ray.origin, origin_t_min);
  _mm_store_ps(state.ray.direction, direction_t_max);
  const ObjectRay world = {without_fourth_lane(origin_t_min), without_fourth_lane(direction_t_max)};
  const float t_min = origin_t_min[3];
  const float t_max = direction_t_max[3];
  if (top_level == nullptr || top_level->scene() == nullptr || !is_valid(world, t_min, t_max))
      [[unlikely]] {
    return run_miss(state);
  }
  begin_search(state, arguments.ray_flags | worker.dispatch->pipeline_flags,
               arguments.instance_inclusion_mask, top_level, t_min, t_max);

  RTCRayHit ray_hit;
  ExactState exact;
  if (top_level->exact_frame() == nullptr) [[likely]] {
    begin_embree_ray(state, world, ray_hit.ray);
  } else if (!begin_exact_ray(state, exact, ray_hit.ray)) {
    return run_miss(state);
  }
  if (asks_visibility(state)) {
    ++worker.counters.visibility_rays;
    shim::occluded(top_level->scene(), state.query, &ray_hit.ray);
    if (ray_hit.ray.tfar >= 0) return run_miss(state);
    return;
  }
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  shim::intersect(top_level->scene(), state.query, &ray_hit);
  if (ray_hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return run_miss(state);
  if ((state.ray_flags & kRaySkipClosestHitShader) == 0) run_closest_hit(state, ray_hit);
}

}  // namespace kaamos::embree
