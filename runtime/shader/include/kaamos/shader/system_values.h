// SPDX-License-Identifier: MIT
//
// System values of ray and compute shaders, from what the backend stored in the Invocation.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/intrinsics_geometry.h"

namespace kaamos::shader {

KAAMOS_INLINE uint3 dispatch_rays_index(const Invocation& invocation) {
  return {{invocation.index[0], invocation.index[1], invocation.index[2]}};
}
KAAMOS_INLINE uint3 dispatch_rays_dimensions(const Invocation& invocation) {
  const uint32_t* size = invocation.dispatch->dimensions;
  return {{size[0], size[1], size[2]}};
}

// The checker allows these only in stages with a ray, and transforms not in miss shaders.
KAAMOS_INLINE float3 world_ray_origin(const Invocation& invocation) {
  const float* v = invocation.ray->ray.origin;
  return {{v[0], v[1], v[2]}};
}
KAAMOS_INLINE float3 world_ray_direction(const Invocation& invocation) {
  const float* v = invocation.ray->ray.direction;
  return {{v[0], v[1], v[2]}};
}

KAAMOS_INLINE float3x4 read_transform(const float* rows) {
  float3x4 m;
  __builtin_memcpy(&m, rows, sizeof(m));
  return m;
}
// For a ray query's hit: zeros if there is none.
KAAMOS_INLINE float3x4 load_transform(const float* rows) {
  return rows != nullptr ? read_transform(rows) : float3x4{};
}
KAAMOS_INLINE float3x4 object_to_world_3x4(const Invocation& invocation) {
  return read_transform(invocation.ray->object_to_world);
}
KAAMOS_INLINE float3x4 world_to_object_3x4(const Invocation& invocation) {
  return read_transform(invocation.ray->world_to_object);
}
KAAMOS_INLINE float4x3 object_to_world_4x3(const Invocation& invocation) {
  return transpose(object_to_world_3x4(invocation));
}
KAAMOS_INLINE float4x3 world_to_object_4x3(const Invocation& invocation) {
  return transpose(world_to_object_3x4(invocation));
}

// [DXR: ObjectRayOrigin, ObjectRayDirection]: the direction is not normalised.
KAAMOS_INLINE float3 object_ray_origin(const Invocation& invocation) {
  return mul(world_to_object_3x4(invocation), make<float4>(world_ray_origin(invocation), 1.0f));
}
KAAMOS_INLINE float3 object_ray_direction(const Invocation& invocation) {
  return mul(world_to_object_3x4(invocation), make<float4>(world_ray_direction(invocation), 0.0f));
}

// ---------------------------------------------------------------------------------------------
// Compute. V is the parameter's type: uint or int, scalar or vector of up to 3.

template <class V>
KAAMOS_INLINE V group_value(const uint32_t value[3]) {
  V result{};
  for (int i = 0; i < shape<V>::count && i < 3; ++i) {
    component(result, i) = static_cast<scalar_of<V>>(value[i]);
  }
  return result;
}
// SV_DispatchThreadID = SV_GroupID * numthreads + SV_GroupThreadID
template <class V>
KAAMOS_INLINE V dispatch_thread_id(const ComputeGroup& group, const uint32_t size[3],
                                   const uint32_t thread[3]) {
  const uint32_t id[3] = {group.group_id[0] * size[0] + thread[0],
                          group.group_id[1] * size[1] + thread[1],
                          group.group_id[2] * size[2] + thread[2]};
  return group_value<V>(id);
}

}  // namespace kaamos::shader
