// SPDX-License-Identifier: MIT
// FEATURE: extended RayQuery with two arguments
// EXPECT u32 0 1
// EXPECT f32 4 7 4
// EXPECT u32 8 1
// EXPECT u32 12 1
// EXPECT u32 16 0
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {}

// RayQuery<F> and RayQuery<F, 0> are one type.
uint finish(RayQuery<RAY_FLAG_FORCE_OPAQUE> query) {
  query.Proceed();
  return query.CommittedStatus();
}

[shader("raygeneration")]
void Main() {
  RayDesc ray = test_ray(-10);
  ray.TMin = 0.5;
  RayQuery<RAY_FLAG_FORCE_OPAQUE, 0> q;
  q.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  results.Store(0, finish(q));
  results.Store(4, asuint(q.CommittedRayT()));
  RayQuery<RAY_FLAG_FORCE_OPAQUE, RAYQUERY_FLAG_NONE> named;
  named.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  const RAYQUERY_FLAG allowed = RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS;
  results.Store3(8, uint3(finish(named), allowed, RAYQUERY_FLAG_NONE));
}
