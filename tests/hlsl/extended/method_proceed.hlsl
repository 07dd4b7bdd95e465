// SPDX-License-Identifier: MIT
// FEATURE: extended .Proceed
// BREAKS: KA0409, KA0410
// EXPECT u32 0 3
// EXPECT u32 4 0
// EXPECT u32 8 0
// EXPECT u32 12 1
// EXPECT u32 16 1
// EXPECT u32 20 0
// EXPECT u32 24 0
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {}

[shader("raygeneration")]
void Main() {
  RayQuery<RAY_FLAG_NONE> q;
  q.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, test_ray(-10));
  uint n = 0;
  while (q.Proceed()) ++n;
  results.Store(0, n);
  uint again = 0;
  for (uint i = 0; i < 5; ++i) again += q.Proceed() ? 1 : 0;
  results.Store(4, again);
  q.CommitNonOpaqueTriangleHit();  // there is no candidate any more
  results.Store(8, q.CommittedStatus());
  // Abort keeps the committed hit.
  q.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, test_ray(-10));
  q.Proceed();
  q.CommitNonOpaqueTriangleHit();
  q.Abort();
  results.Store(12, q.Proceed() ? 2 : 1);
  results.Store(16, q.CommittedStatus());
  // A query that is never traced.
  RayQuery<RAY_FLAG_NONE> idle;
  results.Store(20, idle.Proceed() ? 1 : 0);
  results.Store(24, idle.CommittedStatus() + idle.CommittedInstanceID() + idle.CandidateType());
}
