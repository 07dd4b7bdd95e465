// SPDX-License-Identifier: MIT
// FEATURE: extended RayQuery
// EXPECT u32 0 1
// EXPECT f32 4 7 4
// EXPECT u32 8 7
// EXPECT u32 12 0
// EXPECT u32 16 0
// EXPECT u32 20 0
// EXPECT f32 24 0.5 4
// EXPECT f32 28 0.25 4
// EXPECT f32 32 -2 4
// EXPECT f32 36 -1.875 4
// EXPECT f32 40 0.125 4
// EXPECT f32 44 5
// EXPECT f32 48 5
// EXPECT f32 52 -0.625
// EXPECT f32 56 -0.625
// EXPECT u32 60 1
// EXPECT u32 64 128
// EXPECT f32 68 -3
// EXPECT f32 72 0.5
// EXPECT u32 76 0
// EXPECT u32 80 2
// EXPECT u32 84 2
// EXPECT f32 88 15 4
// EXPECT f32 92 1
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {}

// A query parameter always is the caller's object, whatever its direction.
bool step(RayQuery<RAY_FLAG_NONE> query) {
  return query.Proceed();
}
void commit(inout RayQuery<RAY_FLAG_NONE> query) {
  query.CommitNonOpaqueTriangleHit();
}

[shader("raygeneration")]
void Main() {
  RayDesc ray = test_ray(-10);
  ray.TMin = 0.5;
  RayQuery<RAY_FLAG_NONE> q;
  q.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  RayQuery<RAY_FLAG_NONE> same = q;  // a second name for the same query
  while (step(q)) commit(same);
  results.Store(0, q.CommittedStatus());
  results.Store(4, asuint(q.CommittedRayT()));
  results.Store(8, q.CommittedInstanceID());
  results.Store(12, q.CommittedInstanceIndex());
  results.Store(16, q.CommittedGeometryIndex());
  results.Store(20, q.CommittedPrimitiveIndex());
  results.Store2(24, asuint(q.CommittedTriangleBarycentrics()));
  results.Store(32, asuint(q.CommittedObjectRayOrigin().x));
  results.Store(36, asuint(q.CommittedObjectRayOrigin().z));
  results.Store(40, asuint(same.CommittedObjectRayDirection().z));
  results.Store(44, asuint(q.CommittedObjectToWorld3x4()[2][3]));
  results.Store(48, asuint(q.CommittedObjectToWorld4x3()[3][2]));
  results.Store(52, asuint(q.CommittedWorldToObject3x4()[2][3]));
  results.Store(56, asuint(q.CommittedWorldToObject4x3()[3][2]));
  results.Store(60, q.CommittedTriangleFrontFace() ? 1 : 0);

  // Two queries at once, each with its own flags.
  RayQuery<RAY_FLAG_CULL_NON_OPAQUE> none;
  none.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  results.Store(64, none.RayFlags());
  results.Store(68, asuint(q.WorldRayOrigin().x));
  results.Store(72, asuint(none.RayTMin()));
  results.Store(76, q.CommittedInstanceContributionToHitGroupIndex());
  RayQuery<RAY_FLAG_NONE> other;
  other.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  q.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  uint steps = 0;
  uint geometries = 0;
  uint more = 0;
  while (q.Proceed()) {
    if (other.Proceed()) more += 1;
    if (none.Proceed()) steps += 100;
    if (q.CandidateGeometryIndex() == 0) continue;
    steps += 1;
    geometries += q.CandidateGeometryIndex();
    if (q.CandidatePrimitiveIndex() == 1) q.CommitNonOpaqueTriangleHit();
  }
  // The farther geometry may be a candidate before the nearer one is committed, or not at all.
  results.Store(80, min(steps, 1) + geometries - steps + 1);
  results.Store(84, min(more, 2));
  results.Store(88, asuint(q.CommittedRayT()));
  results.Store(92, asuint(q.WorldRayDirection().z));
}
