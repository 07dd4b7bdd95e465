// SPDX-License-Identifier: MIT
// OPTIONS: -T lib_6_9 -disable-payload-qualifiers
// Queries that meet opacity micromaps, with and without permission.
#include "common.hlsli"

struct Answer {
  uint status;
  uint candidates;  // and 0x100 for each that is a box and not opaque
  uint flags;
  uint isHit;  // of the hit object made of the query
};

Answer askWith(Ray ray) {
  RayQuery<RAY_FLAG_NONE, RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS> query;
  query.TraceRayInline(scene, ray.flags, ray.mask, describe(ray));
  Answer answer = (Answer)0;
  while (query.Proceed()) {
    ++answer.candidates;
    if (query.CandidateType() == CANDIDATE_NON_OPAQUE_TRIANGLE) {
      query.CommitNonOpaqueTriangleHit();
    } else {
      answer.candidates += query.CandidateProceduralPrimitiveNonOpaque() ? 0x100 : 0;
      query.CommitProceduralPrimitiveHit(5);
    }
  }
  answer.status = query.CommittedStatus();
  answer.flags = query.RayFlags();
  answer.isHit = dx::HitObject::FromRayQuery(query).IsHit();
  return answer;
}

Answer askWithout(Ray ray) {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, ray.flags, ray.mask, describe(ray));
  Answer answer = (Answer)0;
  while (query.Proceed()) {
    ++answer.candidates;
    query.CommitNonOpaqueTriangleHit();
  }
  answer.status = query.CommittedStatus();
  answer.flags = query.RayFlags();
  answer.isHit = dx::HitObject::FromRayQuery(query).IsHit();
  return answer;
}

[shader("raygeneration")]
void AskOfMicromaps() {
  const uint i = DispatchRaysIndex().x;
  const Ray ray = rays[i];
  if (ray.extra.x != 0) {
    words.Store<Answer>(16 * i, askWith(ray));
  } else {
    words.Store<Answer>(16 * i, askWithout(ray));
  }
}
