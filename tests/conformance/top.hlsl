// SPDX-License-Identifier: MIT
// Every way to ask for the positions of the triangle that a ray hits.
// OPTIONS: -enable-experimental -T lib_6_10 -disable-payload-qualifiers
#include "common.hlsli"

// Where each of them writes, in slots of 36 bytes.
static const uint kAnyHit = 0;
static const uint kClosestHit = 1;
static const uint kCandidate = 2;
static const uint kCommitted = 3;
static const uint kObject = 4;
static const uint kObjectOfQuery = 5;
static const uint kInvoked = 6;
static const uint kRay = 7;  // the object-space ray where it hits, and the barycentrics
static const uint kSlots = 8;

struct Payload {
  uint slot;  // of the closest-hit shader
};

void write(uint slot, BuiltInTrianglePositions at) {
  const uint offset = (DispatchRaysIndex().x * kSlots + slot) * 36;
  words.Store3(offset, asuint(at.p0));
  words.Store3(offset + 12, asuint(at.p1));
  words.Store3(offset + 24, asuint(at.p2));
}

[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  write(kAnyHit, TriangleObjectPositions());
}

[shader("closesthit")]
void Closest(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  write(payload.slot, TriangleObjectPositions());
  if (payload.slot != kClosestHit) return;
  BuiltInTrianglePositions ray;
  ray.p0 = ObjectRayOrigin() + RayTCurrent() * ObjectRayDirection();
  ray.p1 = float3(attributes.barycentrics, asfloat(ClusterID()));
  ray.p2 = 0;
  write(kRay, ray);
}

[shader("intersection")]
void Boxed() {
  BuiltInTriangleIntersectionAttributes attributes;
  attributes.barycentrics = 7;
  ReportHit(5, 3, attributes);
}

[shader("miss")]
void Miss(inout Payload payload) {}

// Commits every candidate; boxes at 5.
[shader("raygeneration")]
void Ask() {
  const Ray ray = rays[DispatchRaysIndex().x];
  const RayDesc desc = describe(ray);
  Payload payload;
  payload.slot = kClosestHit;
  TraceRay(scene, ray.flags, ray.mask, 0, 0, 0, desc, payload);

  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, ray.flags, ray.mask, desc);
  while (query.Proceed()) {
    if (query.CandidateType() == CANDIDATE_NON_OPAQUE_TRIANGLE) {
      write(kCandidate, query.CandidateTriangleObjectPositions());
      query.CommitNonOpaqueTriangleHit();
    } else {
      query.CommitProceduralPrimitiveHit(5);
    }
  }
  write(kCommitted, query.CommittedTriangleObjectPositions());
  write(kObjectOfQuery, dx::HitObject::FromRayQuery(query).TriangleObjectPositions());

  payload.slot = kInvoked;
  const dx::HitObject hit =
      dx::HitObject::TraceRay(scene, ray.flags, ray.mask, 0, 0, 0, desc, payload);
  write(kObject, hit.TriangleObjectPositions());
  dx::HitObject::Invoke(hit, payload);
}

// Objects that are no hit.
[shader("raygeneration")]
void AskOfNothing() {
  write(kObject, dx::HitObject::MakeNop().TriangleObjectPositions());
  write(kObjectOfQuery,
        dx::HitObject::MakeMiss(0, 0, describe(rays[0])).TriangleObjectPositions());
}

// What there is to know of clusters on a device without any.
[shader("raygeneration")]
void AskOfClusters() {
  RayQuery<RAY_FLAG_NONE, RAYQUERY_FLAG_ALLOW_CLUSTERED_GEOMETRY> query;
  query.TraceRayInline(scene, 0, 0xFF, describe(rays[0]));
  query.Proceed();
  words.Store4(0, uint4(query.CandidateClusterID(), query.CommittedClusterID(),
                        dx::HitObject::FromRayQuery(query).GetClusterID(), CLUSTER_ID_INVALID));
}
