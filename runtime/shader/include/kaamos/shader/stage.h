// SPDX-License-Identifier: MIT
//
// Calls to the backend: TraceRay, ReportHit, CallShader, barriers; and reading hit attributes.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/half.h"

namespace kaamos::shader {

inline TraceRayArguments trace_ray_arguments(const Descriptor& acceleration_structure,
                                             uint32_t ray_flags, uint32_t instance_inclusion_mask,
                                             uint32_t ray_contribution_to_hit_group_index,
                                             uint32_t multiplier_for_geometry_contribution,
                                             uint32_t miss_shader_index, uint32_t payload_bytes) {
  TraceRayArguments arguments;
  const bool usable = acceleration_structure.kind == DescriptorKind::kAccelerationStructure;
  arguments.acceleration_structure = usable ? acceleration_structure.address : 0;
  arguments.ray_flags = ray_flags;
  arguments.instance_inclusion_mask = instance_inclusion_mask & 0xFFu;
  arguments.ray_contribution_to_hit_group_index = ray_contribution_to_hit_group_index & 0xFu;
  arguments.multiplier_for_geometry_contribution = multiplier_for_geometry_contribution & 0xFu;
  arguments.miss_shader_index = miss_shader_index & 0xFFFFu;
  arguments.payload_bytes = payload_bytes;
  return arguments;
}

// Ray is HLSL's RayDesc as the emitter declares it, with the same members in the same order.
template <class Ray, class Payload>
inline void trace_ray(Invocation& invocation, const Descriptor& acceleration_structure,
                      uint32_t ray_flags, uint32_t instance_inclusion_mask,
                      uint32_t ray_contribution_to_hit_group_index,
                      uint32_t multiplier_for_geometry_contribution, uint32_t miss_shader_index,
                      const Ray& ray, Payload& payload) {
  static_assert(sizeof(Ray) == sizeof(RayDesc));
  const TraceRayArguments arguments =
      trace_ray_arguments(acceleration_structure, ray_flags, instance_inclusion_mask,
                          ray_contribution_to_hit_group_index, multiplier_for_geometry_contribution,
                          miss_shader_index, sizeof(Payload));
  const auto& [origin, t_min, direction, t_max] = ray;
  const RayLanes origin_t_min = {origin[0], origin[1], origin[2], t_min};
  const RayLanes direction_t_max = {direction[0], direction[1], direction[2], t_max};
  invocation.dispatch->services->trace_ray(invocation, arguments, &payload, origin_t_min,
                                           direction_t_max);
}

// Sets `ended` if the hit ends the shader; the caller must then return at once. [DXR: ReportHit]
template <class Attributes>
inline bool report_hit(Invocation& invocation, bool& ended, float t, uint32_t hit_kind,
                       const Attributes& attributes) {
  const ReportHitResult result = invocation.dispatch->services->report_hit(
      invocation, t, hit_kind, &attributes, sizeof(Attributes));
  ended = ended || result == ReportHitResult::kEndSearch;
  return result != ReportHitResult::kRejected;
}

template <class Data>
inline void call_shader(Invocation& invocation, uint32_t shader_index, Data& data) {
  invocation.dispatch->services->call_shader(invocation, shader_index, &data, sizeof(Data));
}

// Attributes are the bytes of the structure that was passed to ReportHit, or two floats for a
// triangle.
template <class Attributes>
KAAMOS_INLINE Attributes load_attributes(const void* bytes) {
  Attributes attributes;
  __builtin_memcpy(&attributes, bytes, sizeof(attributes));
  return attributes;
}

// The values of the IR's BarrierFlags.
enum BarrierScope : uint32_t { kGroupMemory = 1, kDeviceMemory = 2, kGroupSync = 4 };

inline void barrier(Invocation& invocation, ComputeGroup* group, uint32_t scope) {
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
  if ((scope & kGroupSync) != 0 && group != nullptr) {
    invocation.dispatch->services->group_barrier(*group);
  }
}

}  // namespace kaamos::shader
