// SPDX-License-Identifier: MIT
// FEATURE: extended TriangleObjectPositions, ClusterID, DebugBreak, IsDebuggingEnabled
// OPTIONS: -enable-experimental -T lib_6_10 -disable-payload-qualifiers
// EXPECT f32 0 4 81 1 4
// EXPECT u32 16 2 1 0 0
// EXPECT f32 32 1 1 4 4
// EXPECT f32 48 4 -4 1 4
// EXPECT f32 64 4 81 1 4
// EXPECT u32 80 1 1 1 0
#include "scene.hlsli"

// Hits before t = 6 are ignored, so that both triangles are seen.
[shader("anyhit")]
void Second(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  const BuiltInTrianglePositions at = TriangleObjectPositions();
  payload.numbers.x += 1;
  payload.color.y += 10 * at.p1.y + at.p2.z;
  if (RayTCurrent() < 6) IgnoreHit();
}

float4 corners(BuiltInTrianglePositions at, float second) {
  return float4(at.p2.x, second, at.p0.z, at.p1.y);
}

[shader("closesthit")]
void Further(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color = corners(TriangleObjectPositions(), payload.color.y);
  payload.numbers.y = ClusterID() == CLUSTER_ID_INVALID;
  if (payload.color.x < 0) DebugBreak();
}

[shader("raygeneration")]
void main() {
  const float z = results.Load(65532);  // 0, known at run time only
  store(0, trace(RAY_FLAG_NONE, 0x0F, test_ray(z)));

  RayQuery<RAY_FLAG_NONE, RAYQUERY_FLAG_ALLOW_CLUSTERED_GEOMETRY> query;
  query.TraceRayInline(scene, RAY_FLAG_NONE, 0x0F, test_ray(z));
  float seen = 0;
  while (query.Proceed()) {
    seen += query.CandidateTriangleObjectPositions().p0.z;
    if (query.CandidateTriangleRayT() > 6) query.CommitNonOpaqueTriangleHit();
  }
  const BuiltInTrianglePositions committed = query.CommittedTriangleObjectPositions();
  const dx::HitObject object = dx::HitObject::FromRayQuery(query);
  results.Store<float4>(32, float4(seen, committed.p0.z, committed.p2.x,
                                   object.TriangleObjectPositions().p1.y));

  Payload payload = (Payload)0;
  const dx::HitObject hit =
      dx::HitObject::TraceRay(scene, RAY_FLAG_NONE, 0x0F, 0, 0, 0, test_ray(z), payload);
  results.Store<float3>(48, hit.TriangleObjectPositions().p2);
  results.Store<float>(60, hit.TriangleObjectPositions().p1.y);
  dx::HitObject::Invoke(hit, payload);
  results.Store<float4>(64, payload.color);

  if (!dx::IsDebuggingEnabled()) DebugBreak();
  results.Store4(80, uint4(query.CommittedClusterID() == CLUSTER_ID_INVALID,
                           object.GetClusterID() == CLUSTER_ID_INVALID,
                           hit.GetClusterID() == CLUSTER_ID_INVALID, dx::IsDebuggingEnabled()));
}
