// SPDX-License-Identifier: MIT
// Rays that only ask whether something is in the way. The shapes of lamps never are.
#ifndef KAAMOS_VISIBILITY_HLSLI
#define KAAMOS_VISIBILITY_HLSLI

#include "alpha_test.hlsli"

struct VisibilityPayload {
  float visibility;  // 0 until the miss shader has run
};

[shader("miss")]
void VisibilityMiss(inout VisibilityPayload payload) {
  payload.visibility = 1.0;
}

[shader("anyhit")]
void VisibilityAnyHit(inout VisibilityPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

// 1 if nothing is hit up to t_max. The origin must be off the surface.
float TraceVisibility(float3 origin, float3 direction, float t_max) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = t_max;
  VisibilityPayload payload;
  payload.visibility = 0.0;
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER,
           kMaskWithoutLamps, kRayTypeVisibility, kRayTypeCount, kRayTypeVisibility, ray, payload);
  return payload.visibility;
}

#endif
