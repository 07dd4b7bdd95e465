// SPDX-License-Identifier: MIT
// FEATURE: extended .CandidateType
// EXPECT u32 0 3
// EXPECT u32 4 1
// EXPECT u32 8 9
// EXPECT u32 12 1
// EXPECT u32 16 1
// EXPECT u32 20 4
// EXPECT f32 24 -20 4
// EXPECT f32 28 45 8
// EXPECT f32 32 1.5 8
// EXPECT u32 36 3
// EXPECT f32 40 -3
#include "scene.hlsli"

[shader("intersection")]
void Box() {}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {}

[shader("raygeneration")]
void Main() {
  RayQuery<RAY_FLAG_NONE> q;
  q.TraceRayInline(scene, RAY_FLAG_NONE, 0xff, test_ray(-10));
  uint triangles = 0;
  uint boxes = 0;
  uint front = 0;
  float distance = 0;
  float barycentrics = 0;
  while (q.Proceed()) {
    if (q.CandidateType() == CANDIDATE_NON_OPAQUE_TRIANGLE) {
      ++triangles;
      distance += q.CandidateTriangleRayT();
      barycentrics += q.CandidateTriangleBarycentrics().x;
      front += q.CandidateTriangleFrontFace() ? 1 : 0;
      continue;
    }
    ++boxes;
    results.Store(8, q.CandidateInstanceID());
    results.Store(12, q.CandidatePrimitiveIndex());
    results.Store(16, q.CandidateProceduralPrimitiveNonOpaque() ? 1 : 0);
    results.Store(20, q.CandidateInstanceContributionToHitGroupIndex());
    results.Store(24, asuint(q.CandidateWorldToObject3x4()[2][3]));
    results.Store(40, asuint(q.CandidateObjectToWorld4x3()[3][0]));
  }
  results.Store(0, triangles);
  results.Store(4, boxes);
  results.Store(28, asuint(distance));
  results.Store(32, asuint(barycentrics));
  results.Store(36, front);
}
