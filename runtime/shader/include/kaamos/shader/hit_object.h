// SPDX-License-Identifier: MIT
//
// dx::HitObject: what shaders do with one beyond reading its words. Hit is the struct as the
// emitter declares it, with the members of HitObject in the same order.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/stage.h"

namespace kaamos::shader {

// The bytes of a value as another type; what is beyond them is 0.
template <class To, class From>
KAAMOS_INLINE To same_bytes(const From& from) {
  To to{};
  __builtin_memcpy(&to, &from, sizeof(to) < sizeof(from) ? sizeof(to) : sizeof(from));
  return to;
}

template <class Hit>
KAAMOS_INLINE HitObject plain_hit(const Hit& hit) {
  static_assert(sizeof(Hit) == sizeof(HitObject));
  HitObject plain;
  __builtin_memcpy(&plain, &hit, sizeof(plain));
  return plain;
}

template <class Hit, class Ray, class Payload>
inline Hit trace_hit_object(Invocation& invocation, const Descriptor& acceleration_structure,
                            uint32_t ray_flags, uint32_t instance_inclusion_mask,
                            uint32_t ray_contribution_to_hit_group_index,
                            uint32_t multiplier_for_geometry_contribution,
                            uint32_t miss_shader_index, const Ray& ray, Payload& payload) {
  static_assert(sizeof(Hit) == sizeof(HitObject) && sizeof(Ray) == sizeof(RayDesc));
  const TraceRayArguments arguments =
      trace_ray_arguments(acceleration_structure, ray_flags, instance_inclusion_mask,
                          ray_contribution_to_hit_group_index, multiplier_for_geometry_contribution,
                          miss_shader_index, sizeof(Payload));
  RayDesc plain;
  __builtin_memcpy(&plain, &ray, sizeof(plain));
  HitObject hit;
  invocation.dispatch->services->trace_hit_object(invocation, arguments, &payload,
                                                  origin_t_min(plain), direction_t_max(plain), hit);
  return same_bytes<Hit>(hit);
}

template <class Hit, class Payload>
inline void invoke_hit_object(Invocation& invocation, const Hit& hit, Payload& payload) {
  invocation.dispatch->services->invoke_hit_object(invocation, plain_hit(hit), &payload,
                                                   sizeof(Payload));
}

template <class Hit>
inline uint32_t record_constant(Invocation& invocation, const Hit& hit, uint32_t offset) {
  return invocation.dispatch->services->record_constant(invocation, plain_hit(hit), offset);
}

}  // namespace kaamos::shader
