// SPDX-License-Identifier: MIT
//
// RayQuery: what shaders do with one. The backend searches; what is committed and when a query ends
// is decided here, in the same way for emitted and interpreted shaders.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/system_values.h"

namespace kaamos::shader {

inline constexpr uint32_t kQueryTriangle = 0;  // CANDIDATE_NON_OPAQUE_TRIANGLE
inline constexpr uint32_t kQueryProcedural = 1;
inline constexpr uint32_t kCommittedTriangle = 1;
inline constexpr uint32_t kCommittedProcedural = 2;

inline void begin_query(Invocation& invocation, RayQuery& query, const Descriptor& scene,
                        uint32_t ray_flags, uint32_t mask, const RayDesc& ray) {
  const bool usable = scene.kind == DescriptorKind::kAccelerationStructure;
  const RayQueryArguments arguments = {usable ? scene.address : 0, ray_flags, mask & 0xFFu};
  invocation.dispatch->services->begin_query(invocation, query, arguments, ray);
}

// Ray is HLSL's RayDesc as the emitter declares it, with the same members in the same order.
template <class Ray>
inline void trace_ray_inline(Invocation& invocation, RayQuery& query, const Descriptor& scene,
                             uint32_t ray_flags, uint32_t mask, const Ray& ray) {
  static_assert(sizeof(Ray) == sizeof(RayDesc));
  RayDesc plain;
  __builtin_memcpy(&plain, &ray, sizeof(plain));
  begin_query(invocation, query, scene, ray_flags, mask, plain);
}

inline bool query_proceed(Invocation& invocation, RayQuery& query) {
  query.has_candidate = !query.ended && invocation.dispatch->services->proceed(invocation, query);
  if (!query.has_candidate) {
    query.ended = true;  // for good [DXR: RayQuery Proceed]
    query.candidate = {};
  }
  return query.has_candidate;
}

inline void query_abort(RayQuery& query) {
  query.ended = true;
}

inline void query_commit(RayQuery& query, uint32_t status, float t) {
  query.committed = query.candidate;
  query.committed.type = status;
  query.committed.t = t;
  constexpr uint32_t kAcceptFirstHitAndEndSearch = 4;
  if ((query.ray_flags & kAcceptFirstHitAndEndSearch) != 0) query.ended = true;
}
inline void query_commit_triangle(RayQuery& query) {
  if (!query.has_candidate || query.candidate.type != kQueryTriangle) return;
  // The range was checked when it became a candidate. A second call changes nothing.
  if (query.candidate.t < query.committed.t) {
    query_commit(query, kCommittedTriangle, query.candidate.t);
  }
}
// A t outside the ray is undefined in DXR; here it is not a hit, as in drivers.
inline void query_commit_procedural(RayQuery& query, float t) {
  if (!query.has_candidate || query.candidate.type != kQueryProcedural) return;
  if (t >= query.ray.t_min && t <= query.committed.t) {
    query_commit(query, kCommittedProcedural, t);
  }
}

KAAMOS_INLINE float2 query_barycentrics(const RayQueryHit& hit) {
  return {{hit.barycentrics[0], hit.barycentrics[1]}};
}
KAAMOS_INLINE float3 query_world_origin(const RayQuery& query) {
  return {{query.ray.origin[0], query.ray.origin[1], query.ray.origin[2]}};
}
KAAMOS_INLINE float3 query_world_direction(const RayQuery& query) {
  return {{query.ray.direction[0], query.ray.direction[1], query.ray.direction[2]}};
}
KAAMOS_INLINE float3 query_object_origin(const RayQuery& query, const RayQueryHit& hit) {
  return mul(load_transform(hit.world_to_object), make<float4>(query_world_origin(query), 1.0f));
}
KAAMOS_INLINE float3 query_object_direction(const RayQuery& query, const RayQueryHit& hit) {
  return mul(load_transform(hit.world_to_object), make<float4>(query_world_direction(query), 0.0f));
}

}  // namespace kaamos::shader
