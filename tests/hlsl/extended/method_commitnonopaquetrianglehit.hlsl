// SPDX-License-Identifier: MIT
// FEATURE: extended .CommitNonOpaqueTriangleHit
// EXPECT u32 0 1
// EXPECT f32 4 23 4
// EXPECT u32 8 1
// EXPECT u32 12 0
// EXPECT u32 16 1
// EXPECT u32 20 1
// EXPECT f32 24 7 4
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {}
// A query in a hit shader while another ray is being traced.
[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  RayQuery<RAY_FLAG_FORCE_OPAQUE> q;
  q.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, test_ray(-10));
  q.Proceed();
  payload.color.x = q.CommittedRayT();
}

[shader("raygeneration")]
void Main() {
  RayQuery<RAY_FLAG_NONE> q;
  q.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, test_ray(-10));
  while (q.Proceed()) {
    if (q.CandidateGeometryIndex() != 1 || q.CandidatePrimitiveIndex() != 0) continue;
    q.CommitNonOpaqueTriangleHit();
    q.CommitNonOpaqueTriangleHit();
  }
  results.Store(0, q.CommittedStatus());
  results.Store(4, asuint(q.CommittedRayT()));
  results.Store(8, q.CommittedGeometryIndex());
  results.Store(12, q.CommittedPrimitiveIndex());
  // The first commit ends the search.
  q.TraceRayInline(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH, 0xff, test_ray(-10));
  uint shown = 0;
  while (q.Proceed()) {
    ++shown;
    q.CommitNonOpaqueTriangleHit();
  }
  results.Store(16, shown);
  results.Store(20, q.CommittedStatus());
  results.Store(24, asuint(trace(RAY_FLAG_NONE, 0xff, test_ray(-10)).color.x));
}
