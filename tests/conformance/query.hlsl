// SPDX-License-Identifier: MIT
// Inline ray tracing: queries that note what they see.
#include "standard.hlsl"

// The outcome of one query.
struct Asked {
  uint status;
  uint triangles;  // candidates
  uint boxes;
  uint nonOpaqueBoxes;
  float t;
  uint instanceIndex;
  uint instanceID;
  uint contribution;
  uint geometry;
  uint primitive;
  uint frontFace;
  uint flags;
  float2 barycentrics;
  uint statusOnTheWay;  // 1 << status for each that was seen between the candidates
  uint proceeds;        // how many of five further Proceed calls returned true
};

// Bits of Ray.contribution: what to do with candidates. Boxes are hit at asfloat(Ray.extra.x).
static const uint kCommitTriangles = 1;
static const uint kCommitBoxes = 2;
static const uint kAbort = 4;     // after the first candidate
static const uint kTwice = 8;     // commit each one twice
static const uint kStop = 16;     // leave the loop after the first candidate

void meet(RayQuery<RAY_FLAG_NONE> query, Ray ray, inout Asked asked) {
  if (query.CandidateType() == CANDIDATE_NON_OPAQUE_TRIANGLE) {
    ++asked.triangles;
    if (ray.contribution & kCommitTriangles) query.CommitNonOpaqueTriangleHit();
    if (ray.contribution & kTwice) query.CommitNonOpaqueTriangleHit();
    return;
  }
  ++asked.boxes;
  if (query.CandidateProceduralPrimitiveNonOpaque()) ++asked.nonOpaqueBoxes;
  const float t = asfloat(ray.extra.x);
  if ((ray.contribution & kCommitBoxes) && t < query.CommittedRayT()) {
    if (ray.contribution & kTwice) query.CommitProceduralPrimitiveHit(t + 1);
    query.CommitProceduralPrimitiveHit(t);
  }
}

void note(RayQuery<RAY_FLAG_NONE> query, inout Asked asked) {
  asked.status = query.CommittedStatus();
  asked.t = query.CommittedRayT();
  asked.flags = query.RayFlags();
  asked.instanceIndex = asked.geometry = kNothing;
  if (query.CommittedStatus() == COMMITTED_NOTHING) return;
  asked.instanceIndex = query.CommittedInstanceIndex();
  asked.instanceID = query.CommittedInstanceID();
  asked.contribution = query.CommittedInstanceContributionToHitGroupIndex();
  asked.geometry = query.CommittedGeometryIndex();
  asked.primitive = query.CommittedPrimitiveIndex();
  if (query.CommittedStatus() != COMMITTED_TRIANGLE_HIT) return;
  asked.frontFace = query.CommittedTriangleFrontFace();
  asked.barycentrics = query.CommittedTriangleBarycentrics();
}

Asked ask(RaytracingAccelerationStructure structure, Ray ray) {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(structure, ray.flags, ray.mask, describe(ray));
  Asked asked = (Asked)0;
  asked.statusOnTheWay = 1u << query.CommittedStatus();
  while (query.Proceed()) {
    meet(query, ray, asked);
    asked.statusOnTheWay |= 1u << query.CommittedStatus();
    if (ray.contribution & kAbort) query.Abort();
    if (ray.contribution & kStop) break;
  }
  if (!(ray.contribution & kStop)) {
    for (uint i = 0; i < 5; ++i) asked.proceeds += query.Proceed() ? 1 : 0;
  }
  note(query, asked);
  return asked;
}

[shader("raygeneration")]
void Ask() {
  const uint i = DispatchRaysIndex().x;
  words.Store<Asked>(64 * i, ask(scene, rays[i]));
}

// Template flags, which differ from shader to shader.
template <uint Flags>
void askWith(uint place) {
  RayQuery<Flags> query;
  query.TraceRayInline(scene, rays[0].flags, rays[0].mask, describe(rays[0]));
  uint triangles = 0;
  uint boxes = 0;
  while (query.Proceed()) {
    if (query.CandidateType() == CANDIDATE_NON_OPAQUE_TRIANGLE) {
      ++triangles;
    } else {
      ++boxes;
    }
  }
  words.Store4(16 * place, uint4(query.RayFlags(), triangles, boxes, query.CommittedStatus()));
}

[shader("raygeneration")]
void AskWithFlags() {
  askWith<RAY_FLAG_NONE>(0);
  askWith<RAY_FLAG_FORCE_OPAQUE>(1);
  askWith<RAY_FLAG_FORCE_NON_OPAQUE>(2);
  askWith<RAY_FLAG_SKIP_TRIANGLES>(3);
  askWith<RAY_FLAG_SKIP_PROCEDURAL_PRIMITIVES>(4);
  askWith<RAY_FLAG_CULL_NON_OPAQUE>(5);
}

// Abandons rays[0] for rays[1] after its first candidate.
[shader("raygeneration")]
void Restart() {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, 0, 0xFF, describe(rays[0]));
  Asked first = (Asked)0;
  if (query.Proceed()) meet(query, rays[0], first);
  note(query, first);
  query.TraceRayInline(scene, 0, 0xFF, describe(rays[1]));
  Asked fresh = (Asked)0;
  note(query, fresh);
  Asked second = (Asked)0;
  while (query.Proceed()) meet(query, rays[1], second);
  note(query, second);
  words.Store<Asked>(0, first);
  words.Store<Asked>(64, fresh);
  words.Store<Asked>(128, second);
}

[shader("raygeneration")]
void Values() {
  words.Store3(0, uint3(COMMITTED_NOTHING, COMMITTED_TRIANGLE_HIT, COMMITTED_PROCEDURAL_PRIMITIVE_HIT));
  words.Store2(12, uint2(CANDIDATE_NON_OPAQUE_TRIANGLE, CANDIDATE_PROCEDURAL_PRIMITIVE));
}

// Everything that a query says about a candidate and a committed hit; 48 words each.
[shader("raygeneration")]
void Accessors() {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, rays[0].flags, 0xFF, describe(rays[0]));
  words.Store4(1024, uint4(query.RayFlags(), asuint(query.RayTMin()), asuint(query.CommittedRayT()),
                           query.CommittedStatus()));
  words.Store3(1040, asuint(query.WorldRayOrigin()));
  words.Store3(1052, asuint(query.WorldRayDirection()));
  while (query.Proceed()) {
    words.Store4(0, uint4(query.CandidateType(), query.CandidateInstanceIndex(),
                          query.CandidateInstanceID(),
                          query.CandidateInstanceContributionToHitGroupIndex()));
    words.Store2(16, uint2(query.CandidateGeometryIndex(), query.CandidatePrimitiveIndex()));
    words.Store3(32, asuint(query.CandidateObjectRayOrigin()));
    words.Store3(44, asuint(query.CandidateObjectRayDirection()));
    const float3x4 toWorld = query.CandidateObjectToWorld3x4();
    const float3x4 toObject = query.CandidateWorldToObject3x4();
    const float4x3 toWorld4 = query.CandidateObjectToWorld4x3();
    const float4x3 toObject4 = query.CandidateWorldToObject4x3();
    words.Store4(56, asuint(float4(toWorld[0][3], toWorld4[3][0], toObject[0][3], toObject4[3][0])));
    if (query.CandidateType() == CANDIDATE_NON_OPAQUE_TRIANGLE) {
      words.Store4(72, uint4(query.CandidateTriangleFrontFace(),
                             asuint(query.CandidateTriangleRayT()),
                             asuint(query.CandidateTriangleBarycentrics())));
      query.CommitNonOpaqueTriangleHit();
    } else {
      query.CommitProceduralPrimitiveHit(5.5);
    }
  }
  words.Store4(192, uint4(query.CommittedStatus(), query.CommittedInstanceIndex(),
                          query.CommittedInstanceID(),
                          query.CommittedInstanceContributionToHitGroupIndex()));
  words.Store2(208, uint2(query.CommittedGeometryIndex(), query.CommittedPrimitiveIndex()));
  words.Store3(224, asuint(query.CommittedObjectRayOrigin()));
  words.Store3(236, asuint(query.CommittedObjectRayDirection()));
  const float3x4 toWorld = query.CommittedObjectToWorld3x4();
  const float3x4 toObject = query.CommittedWorldToObject3x4();
  const float4x3 toWorld4 = query.CommittedObjectToWorld4x3();
  const float4x3 toObject4 = query.CommittedWorldToObject4x3();
  words.Store4(248, asuint(float4(toWorld[0][3], toWorld4[3][0], toObject[0][3], toObject4[3][0])));
  words.Store(268, asuint(query.CommittedRayT()));
  if (query.CommittedStatus() == COMMITTED_TRIANGLE_HIT) {
    words.Store(264, query.CommittedTriangleFrontFace());
    words.Store2(272, asuint(query.CommittedTriangleBarycentrics()));
  }
}

bool stepParameter(RayQuery<RAY_FLAG_NONE> query) {
  return query.Proceed();
}
void commitInOut(inout RayQuery<RAY_FLAG_NONE> query) {
  query.CommitNonOpaqueTriangleHit();
}

[shader("raygeneration")]
void Aliases() {
  RayQuery<RAY_FLAG_NONE> query;
  RayQuery<RAY_FLAG_NONE> other = query;
  other.TraceRayInline(scene, 0, 0xFF, describe(rays[0]));
  uint candidates = 0;
  while (stepParameter(query)) {
    ++candidates;
    RayQuery<RAY_FLAG_NONE> third = other;
    commitInOut(third);
  }
  words.Store4(0, uint4(candidates, query.CommittedStatus(), asuint(other.CommittedRayT()),
                        other.Proceed()));
}

// Steps rays[0] and rays[1] in turn.
[shader("raygeneration")]
void Interleaved() {
  RayQuery<RAY_FLAG_NONE> a;
  RayQuery<RAY_FLAG_NONE> b;
  a.TraceRayInline(scene, 0, 0xFF, describe(rays[0]));
  b.TraceRayInline(scene, 0, 0xFF, describe(rays[1]));
  Asked askedA = (Asked)0;
  Asked askedB = (Asked)0;
  bool moreA = true;
  bool moreB = true;
  while (moreA || moreB) {
    if (moreA) moreA = a.Proceed();
    if (moreB) moreB = b.Proceed();
    if (moreA) meet(a, rays[0], askedA);
    if (moreB) meet(b, rays[1], askedB);
  }
  note(a, askedA);
  note(b, askedB);
  words.Store<Asked>(0, askedA);
  words.Store<Asked>(64, askedB);
}

// One query of rays[1] from each stage: any-hit 0, intersection 1, closest hit 2, miss 3, callable 4.
void askInStage(uint stage) {
  words.Store<Asked>(1024 + 64 * stage, ask(scene, rays[1]));
}

struct Nothing {
  uint nothing;
};

[shader("raygeneration")]
void StagesAsk() {
  Seen seen = nothingSeen();
  TraceRay(scene, RAY_FLAG_SKIP_TRIANGLES, 0xFF, 0, 0, 0, describe(rays[0]), seen);
  Seen missed = nothingSeen();
  TraceRay(scene, 0, 0, 0, 0, 0, describe(rays[0]), missed);
  Nothing nothing = {0};
  CallShader(0, nothing);
  words.Store<Seen>(0, seen);
}

[shader("anyhit")]
void AnyHitAsks(inout Seen seen, BoxAttributes attributes) {
  askInStage(0);
  ++seen.anyHits;
}
[shader("intersection")]
void BoxAsks() {
  askInStage(1);
  BoxAttributes attributes = {9, 5};
  ReportHit(5, 3, attributes);
}
[shader("closesthit")]
void ClosestAsks(inout Seen seen, BoxAttributes attributes) {
  askInStage(2);
  seen.end = 1;
  seen.t = RayTCurrent();
  seen.boxRecord = attributes.record;
}
[shader("miss")]
void MissAsks(inout Seen seen) {
  askInStage(3);
}
[shader("callable")]
void CallableAsks(inout Nothing nothing) {
  askInStage(4);
}
