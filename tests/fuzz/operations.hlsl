// SPDX-License-Identifier: MIT
// Rays through whatever indirect operations have made, with everything a query tells of a hit.
// OPTIONS: -enable-experimental -T lib_6_10
RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer hits : register(u0);  // how many rays hit something, and a mix of what they saw

[shader("compute")]
[numthreads(32, 1, 1)]
void Look(uint ray : SV_DispatchThreadID) {
  RayDesc desc;
  desc.Origin = float3(float(ray % 8) * 0.5 - 1.9, float(ray / 8) * 0.9 - 1.6, -9);
  desc.Direction = float3(0.03 * float(ray % 3), 0.02, 1);
  desc.TMin = 0;
  desc.TMax = 1e30;
  RayQuery<RAY_FLAG_NONE, RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS |
                              RAYQUERY_FLAG_ALLOW_CLUSTERED_GEOMETRY> query;
  query.TraceRayInline(scene, 0, 0xFF, desc);
  uint seen = 0;
  while (query.Proceed()) {
    seen += query.CandidateClusterID() + query.CandidatePrimitiveIndex();
    seen += asuint(query.CandidateTriangleObjectPositions().p0.x);
    if (query.CandidateGeometryIndex() % 3 != 1) query.CommitNonOpaqueTriangleHit();
  }
  if (query.CommittedStatus() != COMMITTED_TRIANGLE_HIT) return;
  seen += query.CommittedClusterID() + query.CommittedGeometryIndex() + query.CommittedInstanceID();
  seen += query.CommittedPrimitiveIndex() + asuint(query.CommittedTriangleObjectPositions().p2.y);
  uint before;
  hits.InterlockedAdd(0, 1, before);
  hits.InterlockedAdd(4, seen, before);
}
