// SPDX-License-Identifier: MIT
//
// TraceRay for several invocations at once.
#pragma once

#include "kaamos/shader/stage.h"
#include "kaamos/shader/wide.h"

namespace kaamos::shader {

// Ray and Payload are the wide structs for HLSL's RayDesc and for a payload; `first_x` is
// DispatchRaysIndex().x in lane 0.
template <class Ray, class Payload>
inline void trace_rays(Invocation& invocation, uint32_t first_x, const lanes& active,
                       const Descriptor& acceleration_structure, uint32_t ray_flags,
                       uint32_t instance_inclusion_mask,
                       uint32_t ray_contribution_to_hit_group_index,
                       uint32_t multiplier_for_geometry_contribution, uint32_t miss_shader_index,
                       const Ray& ray, Payload& payload) {
  static_assert(sizeof(Ray) == sizeof(LaneRays));
  using LanePayload = Lane<Payload>;
  const TraceRayArguments arguments =
      trace_ray_arguments(acceleration_structure, ray_flags, instance_inclusion_mask,
                          ray_contribution_to_hit_group_index, multiplier_for_geometry_contribution,
                          miss_shader_index, sizeof(LanePayload));
  LanePayload payloads[kLanes];
  each_lane(active, [&](int lane) KAAMOS_INLINE_LAMBDA { payloads[lane] = get(payload, lane); });
  invocation.index[0] = first_x;
  invocation.dispatch->services->trace_rays(
      invocation, arguments, payloads, reinterpret_cast<const LaneRays&>(ray), bits_of(active));
  each_lane(active, [&](int lane) KAAMOS_INLINE_LAMBDA { set(payload, lane, payloads[lane]); });
}

}  // namespace kaamos::shader
