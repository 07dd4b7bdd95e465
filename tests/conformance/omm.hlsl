// SPDX-License-Identifier: MIT
// OPTIONS: -T lib_6_9 -disable-payload-qualifiers
// Queries that meet opacity micromaps, with and without permission.
#include "common.hlsli"

// The status, the number of candidates, and RayFlags().
uint3 askWith(Ray ray) {
  RayQuery<RAY_FLAG_NONE, RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS> query;
  query.TraceRayInline(scene, ray.flags, ray.mask, describe(ray));
  uint candidates = 0;
  while (query.Proceed()) {
    ++candidates;
    query.CommitNonOpaqueTriangleHit();
  }
  return uint3(query.CommittedStatus(), candidates, query.RayFlags());
}

uint3 askWithout(Ray ray) {
  RayQuery<RAY_FLAG_NONE> query;
  query.TraceRayInline(scene, ray.flags, ray.mask, describe(ray));
  uint candidates = 0;
  while (query.Proceed()) {
    ++candidates;
    query.CommitNonOpaqueTriangleHit();
  }
  return uint3(query.CommittedStatus(), candidates, query.RayFlags());
}

[shader("raygeneration")]
void AskOfMicromaps() {
  const uint i = DispatchRaysIndex().x;
  const Ray ray = rays[i];
  words.Store3(16 * i, ray.extra.x != 0 ? askWith(ray) : askWithout(ray));
}
