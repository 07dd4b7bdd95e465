// SPDX-License-Identifier: MIT
// FEATURE: extended .TraceRayInline
// BREAKS: KA0401, KA0402, KA0410
// EXPECT u32 0 0
// EXPECT f32 4 100
// EXPECT u32 8 1
// EXPECT f32 12 7 4
// EXPECT u32 16 0
// EXPECT u32 20 0
// EXPECT f32 24 50
// EXPECT u32 28 5
// EXPECT u32 32 0
// EXPECT u32 36 0
// EXPECT u32 40 0
// EXPECT u32 44 0
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {}

uint count(uint flags, uint mask, RayDesc ray) {
  RayQuery<RAY_FLAG_NONE> q;
  q.TraceRayInline(scene, flags, mask, ray);
  uint n = 0;
  while (q.Proceed()) ++n;
  return n + q.CommittedStatus() * 10;
}

[shader("raygeneration")]
void Main() {
  const RayDesc ray = test_ray(-10);
  RayQuery<RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH> q;
  q.TraceRayInline(scene, RAY_FLAG_CULL_NON_OPAQUE, 0xff, ray);
  q.Proceed();
  results.Store(0, q.CommittedStatus());
  results.Store(4, asuint(q.CommittedRayT()));
  RayQuery<RAY_FLAG_FORCE_OPAQUE> closest;
  closest.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  closest.Proceed();
  results.Store(8, closest.CommittedStatus());
  results.Store(12, asuint(closest.CommittedRayT()));
  // A second TraceRayInline discards everything; nothing is found before Proceed.
  RayDesc shorter = ray;
  shorter.TMax = 50;
  closest.TraceRayInline(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH, 0xff, shorter);
  results.Store(16, closest.CommittedStatus());
  results.Store(20, closest.CommittedInstanceID());
  results.Store(24, asuint(closest.CommittedRayT()));
  results.Store(28, closest.RayFlags());
  // Masks, culling, and invalid rays.
  results.Store(32, count(RAY_FLAG_NONE, 0xf0, ray));
  results.Store(36, count(RAY_FLAG_CULL_FRONT_FACING_TRIANGLES, 0xff, ray));
  RayDesc bad = ray;
  bad.Direction.y = asfloat(0x7fc00000u | results.Load(65532));
  results.Store(40, count(RAY_FLAG_NONE, 0xff, bad));
  bad = ray;
  bad.TMax = -1;
  results.Store(44, count(RAY_FLAG_FORCE_OPAQUE, 0xff, bad));
}
