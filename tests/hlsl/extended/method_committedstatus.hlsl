// SPDX-License-Identifier: MIT
// FEATURE: extended .CommittedStatus
// BREAKS: KA0409, KA0410, KA0411, KA0421
// EXPECT u32 0 0
// EXPECT u32 4 2
// EXPECT f32 8 29.5
// EXPECT u32 12 9
// EXPECT u32 16 1
// EXPECT u32 20 0
// EXPECT u32 24 1
// EXPECT f32 28 7 4
// EXPECT u32 32 0
#include "scene.hlsli"

[shader("intersection")]
void Box() {}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {}

[shader("raygeneration")]
void Main() {
  const float z = asfloat(results.Load(65532));  // 0, known at run time only
  RayQuery<RAY_FLAG_SKIP_TRIANGLES> q;
  q.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, test_ray(-10));
  results.Store(0, q.CommittedStatus());
  while (q.Proceed()) {
    // A hit outside the ray's interval does not count; of several hits the nearest is kept.
    q.CommitProceduralPrimitiveHit(-1 + z);
    q.CommitProceduralPrimitiveHit(101 + z);
    q.CommitProceduralPrimitiveHit(30 + z);
    q.CommitProceduralPrimitiveHit(29.5 + z);
    q.CommitProceduralPrimitiveHit(29.75 + z);
    q.CommitNonOpaqueTriangleHit();
  }
  results.Store(4, q.CommittedStatus());
  results.Store(8, asuint(q.CommittedRayT()));
  results.Store(12, q.CommittedInstanceID());
  results.Store(16, q.CommittedPrimitiveIndex());
  results.Store(20, q.CommittedTriangleFrontFace() ? 1 : 0);
  RayQuery<RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_SKIP_PROCEDURAL_PRIMITIVES> triangles;
  triangles.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, test_ray(-10));
  triangles.Proceed();
  results.Store(24, triangles.CommittedStatus());
  results.Store(28, asuint(triangles.CommittedRayT()));
  RaytracingAccelerationStructure nothing = ResourceDescriptorHeap[60000];
  triangles.TraceRayInline(nothing, RAY_FLAG_NONE, 0xff, test_ray(-10));
  triangles.Proceed();
  results.Store(32, triangles.CommittedStatus());
}
