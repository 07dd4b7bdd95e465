// SPDX-License-Identifier: MIT
// Visibility rays that also say how far away the closest occluder is and whether it moves. Its
// distance gives the width of the penumbra; denoisers need both. [NRD: SIGMA]
#ifndef KAAMOS_OCCLUDER_HLSLI
#define KAAMOS_OCCLUDER_HLSLI

#include "alpha_test.hlsli"

struct OccluderPayload {
  float distance;  // metres to the closest occluder; kNoOccluder: there is none
  float moved;     // 1: it is not where it was in the previous frame
};

static const float kNoOccluder = 3e38;  // farther than any ray

[shader("miss")]
void OccluderMiss(inout OccluderPayload payload) {
  payload.distance = kNoOccluder;
  payload.moved = 0.0;
}

[shader("anyhit")]
void OccluderAnyHit(inout OccluderPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (IsOpenAt(hit.barycentrics)) {
    IgnoreHit();
  }
}

[shader("closesthit")]
void OccluderClosestHit(inout OccluderPayload payload,
                        in BuiltInTriangleIntersectionAttributes hit) {
  payload.distance = RayTCurrent();
  payload.moved = previous_instances[InstanceIndex()].flags != 0 ? 1.0 : 0.0;
}

// The origin must be off the surface.
OccluderPayload TraceOccluder(float3 origin, float3 direction, float t_max) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = t_max;
  OccluderPayload payload;
  payload.distance = kNoOccluder;
  payload.moved = 0.0;
  TraceRay(scene, RAY_FLAG_NONE, kMaskWithoutLamps, kRayTypeVisibility, kRayTypeCount,
           kRayTypeVisibility, ray, payload);
  return payload;
}

// Tells whether nothing is in the way; which occluder it is does not matter. The origin must be off
// the surface.
bool IsOpenTowards(float3 origin, float3 direction, float t_max) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0.0;
  ray.Direction = direction;
  ray.TMax = t_max;
  OccluderPayload payload;
  payload.distance = 0.0;
  payload.moved = 0.0;
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER,
           kMaskWithoutLamps, kRayTypeVisibility, kRayTypeCount, kRayTypeVisibility, ray, payload);
  return payload.distance == kNoOccluder;
}

// 1 / radius of a penumbra, 1/m: how sharply the shadow of an occluder ends. A point light has a
// sharp shadow; so does what touches the surface. Sums of the sharpest stay finite, in any units.
static const float kSharpest = 1e30;
float ShadowSharpness(float penumbra_radius) { return 1.0 / max(penumbra_radius, 1.0 / kSharpest); }

#endif
