// SPDX-License-Identifier: MIT
//
// Procedural primitives: intersection shaders, and what they report.
#include "runtime/embree/intersection.h"

#include <algorithm>
#include <cstring>

#include "runtime/embree/any_hit.h"
#include "runtime/embree/inline_query.h"

namespace kaamos::embree {
namespace {

// A running intersection shader, on one primitive. It has its own values, because any-hit shaders
// run in the middle of it.
struct IntersectionInvocation : shader::Invocation {
  shader::RaySystemValues values;
  RayState* state;
  const GeometryInfo* geometry;
  uint32_t primitive;
  ShaderRecord record;
  RTCRay* ray;
  RTCHit* hit;  // null in an occlusion query

  IntersectionInvocation(RayState& ray_state, const Shader& shader, const ShaderRecord& hit_record,
                         const GeometryInfo& geometry_info, uint32_t primitive_index,
                         RTCRay& embree_ray, RTCHit* embree_hit)
      : shader::Invocation(invocation_of(*ray_state.caller, shader, hit_record, values)),
        values{
            ray_state.values.ray, 0, ray_state.values.ray_flags, 0, 0, 0, 0, 0, nullptr, nullptr},
        state(&ray_state),
        geometry(&geometry_info),
        primitive(primitive_index),
        record(hit_record),
        ray(&embree_ray),
        hit(embree_hit) {}
  // Not copyable, because it points to its own values.
  IntersectionInvocation(const IntersectionInvocation&) = delete;
  IntersectionInvocation& operator=(const IntersectionInvocation&) = delete;
};

void run_intersection(RayState& state, const GeometryInfo& geometry, uint32_t primitive,
                      RTCRay& ray, RTCHit* hit) {
  if (state.ended) return;
  if (!geometry.tested_by_embree && !geometry.padded[primitive].meets(ray)) return;
  if (state.search != nullptr) return state.search->take_box(state, geometry, primitive, ray);
  const ShaderRecord record = hit_record(state, *state.instance, geometry.index);
  if (!record.target->intersection.runs()) return;  // NULL record: nothing is reported
  Worker& worker = *state.worker;
  const Shader& shader = record.target->intersection;
  ++worker.counters.intersection_calls;

  const bool committed = hit != nullptr && hit->geomID != RTC_INVALID_GEOMETRY_ID;
  IntersectionInvocation invocation(state, shader, record, geometry, primitive, ray, hit);
  set_hit_values(state, instance_index(state), geometry.index, primitive, 0,
                 committed ? ray.tfar : state.t_max, invocation.values);
  const RunningShader running(worker, shader);
  shader.as<shader::IntersectionFn>()(invocation);
}

void commit(IntersectionInvocation& invocation, float t, uint32_t hit_kind,
            const uint8_t* attributes) {
  RayState& state = *invocation.state;
  state.committed_t = t;
  state.procedural_hit_kind = hit_kind;
  std::memcpy(state.procedural_attributes, attributes, kMaxAttributeBytes);
  invocation.values.t_current = t;
  if (invocation.hit == nullptr) return;
  invocation.ray->tfar = t;
  invocation.hit->geomID = invocation.geometry->index;
  invocation.hit->primID = invocation.primitive;
  invocation.hit->instID[0] = invocation.values.instance_index;
}

}  // namespace

void intersect_procedural(const RTCIntersectFunctionNArguments* arguments) {
  RayState& state = ray_state_of(arguments->context);
  auto* ray_hit = reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  const float t_before = ray_hit->ray.tfar;
  run_intersection(state, *static_cast<const GeometryInfo*>(arguments->geometryUserPtr),
                   arguments->primID, ray_hit->ray, &ray_hit->hit);
  if (state.ended) ray_hit->ray.tfar = shim::kEndedSearch;
  shim::set_hit(arguments, ray_hit->ray.tfar != t_before);
}

void occlude_procedural(const RTCOccludedFunctionNArguments* arguments) {
  RayState& state = ray_state_of(arguments->context);
  auto* ray = reinterpret_cast<RTCRay*>(arguments->ray);
  run_intersection(state, *static_cast<const GeometryInfo*>(arguments->geometryUserPtr),
                   arguments->primID, *ray, nullptr);
  if (state.ended) ray->tfar = shim::kEndedSearch;
  shim::set_hit(arguments, state.ended);
}

shader::ReportHitResult report_hit(shader::Invocation& base, float t, uint32_t hit_kind,
                                   const void* attributes, uint32_t attribute_bytes) {
  auto& invocation = static_cast<IntersectionInvocation&>(base);
  RayState& state = *invocation.state;
  // ReportHit does not return once the search has ended; a shader that calls it again anyway gets
  // the same answer. [DXR: ReportHit]
  if (state.ended) return shader::ReportHitResult::kEndSearch;
  // The interval is closed at both ends, and the test false for NaN. [DXR: Ray extents]
  if (!(t >= state.t_min && t <= invocation.values.t_current)) {
    return shader::ReportHitResult::kRejected;
  }
  // The candidate's own copy: one that an any-hit shader ignores must leave no trace, and
  // attributes that were not written read as 0.
  alignas(16) uint8_t bytes[kMaxAttributeBytes] = {};
  if (attributes != nullptr) {
    std::memcpy(bytes, attributes, std::min(attribute_bytes, kMaxAttributeBytes));
  }
  bool end_search = (state.ray_flags & kRayAcceptFirstHitAndEndSearch) != 0;
  if (!is_opaque(state, invocation.geometry->opaque) && invocation.record.target->any_hit.runs()) {
    const Candidate candidate = {t, hit_kind, invocation.geometry->index, invocation.primitive,
                                 bytes};
    const auto result = run_any_hit(state, invocation.record, candidate);
    if (result == shader::AnyHitResult::kIgnore) return shader::ReportHitResult::kRejected;
    end_search |= result == shader::AnyHitResult::kAcceptAndEndSearch;
  }
  commit(invocation, t, hit_kind, bytes);
  if (!end_search) return shader::ReportHitResult::kAccepted;
  state.ended = true;
  return shader::ReportHitResult::kEndSearch;
}

}  // namespace kaamos::embree
