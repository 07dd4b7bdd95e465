// SPDX-License-Identifier: MIT
// This file holds what the rays of reflections see: their hit shaders, and the ray itself. Whoever
// includes this defines SunAtHits(): whether what rays hit is lit by the sun, and how
// [hit_shading.hlsli]. [Control; Northlight deck: Reflections]
#ifndef KAAMOS_REFLECTION_SHADING_HLSLI
#define KAAMOS_REFLECTION_SHADING_HLSLI

#include "hit_indirect.hlsli"
#include "reflection_ray.hlsli"

uint SunAtHits();

// Above this roughness reflections are noisy and filtered anyway, so reading a single cell of the
// volume per ray adds little noise. In a mirror it would show. The value lies between two of the
// 8-bit values in g_material (53.55 of 255), so rounding never decides.
static const float kNoisyRoughness = 0.21;

struct ReflectionPayload {
  float3 radiance;
  float distance;        // of the hit, metres; negative: a miss
  float3 volume_jitter;  // of the ray's reads of the volume [VolumeTowards]
};

[shader("miss")]
void ReflectionMiss(inout ReflectionPayload payload) {
  // At the end of the ray: the volume holds the light that arrives from beyond.
  const float3 end = WorldRayOrigin() + WorldRayDirection() * RayTCurrent();
  payload.radiance = VolumeRadiance(end, payload.volume_jitter, WorldRayDirection());
  payload.distance = -1.0;
}

[shader("anyhit")]
void ReflectionAnyHit(inout ReflectionPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void ReflectionClosestHit(inout ReflectionPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  const Surface surface = LoadSurface(hit.barycentrics, ConeWidth());
  payload.radiance = ShadeHit(surface, -WorldRayDirection(), SunAtHits()) +
                     IndirectAtHit(surface, payload.volume_jitter, -WorldRayDirection());
  payload.distance = RayTCurrent();
}

ReflectionPayload FollowReflectionRay(uint2 pixel, ReflectionPoint surface, ReflectionRay sample,
                                      uint index, uint seed) {
  RayDesc ray;
  ray.Origin = surface.origin;
  ray.TMin = 0.0;
  ray.Direction = sample.direction;
  ray.TMax = sample.length;
  ReflectionPayload payload;
  payload.radiance = float3(0, 0, 0);
  payload.distance = -1.0;
  payload.volume_jitter = kEveryCell;
  if (surface.roughness > kNoisyRoughness) {
    payload.volume_jitter = PixelJitter(pixel, index, kReflectionPair + 1, seed);
  }
  TraceRay(scene, RAY_FLAG_NONE, ReflectionMask(surface.roughness), kRayTypeSurface, kRayTypeCount,
           kRayTypeSurface, ray, payload);
  return payload;
}

#endif
