// SPDX-License-Identifier: MIT
// FEATURE: extended arrays of RayQuery
// EXPECT u32 0 1
// EXPECT u32 4 0
// EXPECT f32 8 7 4
// EXPECT u32 12 0
// EXPECT u32 16 1
// EXPECT u32 20 1
#include "scene.hlsli"

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {}

bool step(RayQuery<RAY_FLAG_NONE> query) { return query.Proceed(); }
void commit(inout RayQuery<RAY_FLAG_NONE> query) { query.CommitNonOpaqueTriangleHit(); }
uint trace(RayQuery<RAY_FLAG_NONE> query, RayDesc ray) {
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, ray);
  return 1;
}

[shader("raygeneration")]
void Main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  RayQuery<RAY_FLAG_NONE> q[2][2];
  uint traced = 0;
  for (uint i = z; i < 2; ++i) {
    RayDesc ray = test_ray(-10);
    ray.TMin = 0.5;
    if (i == 1) ray.TMax = 1;  // ends before the triangle
    traced += trace(q[1][i], ray);
    while (step(q[1][i])) commit(q[1][i]);
  }
  results.Store(0, q[1][z].CommittedStatus());
  results.Store(4, q[1][z + 1].CommittedStatus());
  results.Store(8, asuint(q[z + 1][0].CommittedRayT()));
  results.Store(12, q[z + 1][z + 1].CommittedStatus());
  results.Store(16, traced - 1);
  // Constructed, and a second name.
  RayQuery<RAY_FLAG_NONE> made = RayQuery<RAY_FLAG_NONE>();
  RayQuery<RAY_FLAG_NONE> same;
  same = made;
  RayDesc ray = test_ray(-10);
  ray.TMin = 0.5;
  trace(made, ray);
  while (step(same)) commit(same);
  results.Store(20, made.CommittedStatus());
}
