// SPDX-License-Identifier: MIT
//
// TraceRay: guard, traverse, then run the closest-hit or the miss shader.
#include "runtime/embree/trace.h"

#include <cfloat>
#include <limits>

#include "runtime/embree/fault.h"
#include "runtime/embree/memory.h"
#include "runtime/embree/ray_state.h"

namespace kaamos::embree {
namespace {

using shader::TraceRayArguments;

// GeometryClass bits that a ray visits, by its four flags that cull or skip classes (bits 6 to 9)
// and by the instance's opacity. CULL_OPAQUE looks at the opacity after the instance's override.
// [DXR: Ray flags]
struct ClassTable {
  uint8_t classes[16][3];

  constexpr ClassTable() : classes{} {
    for (uint32_t flags = 0; flags < 16; ++flags) {
      uint32_t skipped = 0;
      if ((flags & 4) != 0) skipped |= kTriangleOpaque | kTriangleNonOpaque;
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
constexpr ClassTable kClassTable;

// What Embree may be given: all else, NaN included, is a miss.
bool is_valid(const ObjectRay& spatial, float t_min, float t_max) {
  return is_traceable(spatial) && t_min <= t_max && t_min <= FLT_MAX;
}

// Out of line: only a ray against another structure than the last one comes here.
[[gnu::noinline]] const TopLevel* look_up_top_level(Worker& worker, uint64_t address) {
  worker.cached_top_level = worker.dispatch->memory->find_top_level(address);
  worker.cached_address = address;
  if (worker.cached_top_level == nullptr && address != 0) {
    worker.dispatch->unknown_structure.store(address, std::memory_order_relaxed);
  }
  return worker.cached_top_level.get();
}

const TopLevel* find_top_level(Worker& worker, uint64_t address) {
  if (address == worker.cached_address) return worker.cached_top_level.get();
  return look_up_top_level(worker, address);
}

void begin_query(RayState& state, const TraceRayArguments& arguments, const TopLevel* top_level,
                 float t_min, float t_max) {
  const uint32_t flags = arguments.ray_flags | state.worker->dispatch->pipeline_flags;
  shim::init(state.query);
  state.top_level = top_level;
  state.ray_flags = flags;
  state.inclusion_mask = arguments.instance_inclusion_mask & 0xFFu;
  state.classes = kClassTable.classes[(flags >> 6) & 15];
  state.opacity = (flags & kRayForceOpaque) != 0      ? OpacityOverride::kOpaque
                  : (flags & kRayForceNonOpaque) != 0 ? OpacityOverride::kNonOpaque
                                                      : OpacityOverride::kNone;
  state.ended = false;
  // A negative TMin is undefined in DXR; here it is 0.
  state.t_min = t_min > 0 ? t_min : 0.0f;
  state.t_max = t_max;
  state.t_near = next_above(state.t_min);
  state.t_far = next_below(state.t_max);
  state.committed_t = std::numeric_limits<float>::infinity();
}

void begin_embree_ray(const RayState& state, const ObjectRay& world, RTCRay& ray) {
  const bool closed = state.top_level->has_procedurals();
  _mm_store_ps(&ray.org_x, with_fourth_lane(world.origin, closed ? state.t_min : state.t_near));
  _mm_store_ps(&ray.dir_x, world.direction);  // time 0
  ray.tfar = closed ? state.t_max : state.t_far;
  ray.mask = kAllClasses;
  ray.id = 0;
  ray.flags = 0;
}

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
  const InstanceNode& instance = state.top_level->nodes()[ray_hit.hit.instID[0]];
  const ShaderRecord record = hit_record(state, instance, ray_hit.hit.geomID);
  if (record.target->closest_hit == nullptr) return;
  const Shader& shader = *record.target->closest_hit;
  ++state.worker->counters.closest_hit_calls;

  // A search that was ended early has lost its t in Embree's ray.
  const float t = state.ended ? state.committed_t : ray_hit.ray.tfar;
  const void* attributes = state.procedural_attributes;
  uint32_t hit_kind = state.procedural_hit_kind;
  float barycentrics[2];
  if (!instance.procedural) {
    if (shader.reads_hit_kind) hit_kind = committed_hit_kind(instance, ray_hit);
    barycentrics[0] = ray_hit.hit.u;
    barycentrics[1] = ray_hit.hit.v;
    clamp_barycentrics(barycentrics[0], barycentrics[1]);
    attributes = barycentrics;
  }
  RayInvocation invocation(
      state, shader, record,
      hit_values(state, instance, ray_hit.hit.geomID, ray_hit.hit.primID, hit_kind, t));
  const RunningShader running(*state.worker, shader);
  shader.as<shader::ClosestHitFn>()(invocation, state.payload, attributes);
}

void run_miss(RayState& state) {
  ++state.worker->counters.misses;
  const uint32_t index = state.arguments->miss_shader_index & 0xFFFFu;
  const ShaderRecord record = state.worker->dispatch->miss_table.at(index);
  if (record.target->shader == nullptr) return;
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
  if (caller.depth >= worker.dispatch->max_recursion_depth) {
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
  if (top_level == nullptr || top_level->scene() == nullptr || !is_valid(world, t_min, t_max)) {
    return run_miss(state);
  }
  begin_query(state, arguments, top_level, t_min, t_max);

  RTCRayHit ray_hit;
  begin_embree_ray(state, world, ray_hit.ray);
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
