// SPDX-License-Identifier: MIT
// Traces a buffer of rays into a scene; the shaders note the state they ran in. Serves most rules.
#include "common.hlsli"

[shader("raygeneration")]
void Trace() {
  const uint i = DispatchRaysIndex().x;
  const Ray ray = rays[i];
  Seen seen = nothingSeen();
#ifdef THROUGH_HIT_OBJECTS
  const dx::HitObject hit =
      dx::HitObject::TraceRay(scene, ray.flags, ray.mask, ray.contribution, ray.multiplier,
                              ray.miss, describe(ray), seen);
  dx::MaybeReorderThread(hit);
  dx::HitObject::Invoke(hit, seen);
#else
  TraceRay(scene, ray.flags, ray.mask, ray.contribution, ray.multiplier, ray.miss, describe(ray),
           seen);
#endif
  words.Store<Seen>(64 * i, seen);
}

[shader("raygeneration")]
void WriteOrdinal() {
  words.Store(0, ordinal + 1);
}

[shader("miss")]
void Miss(inout Seen seen) {
  seen.end = 2;
  seen.record = ordinal;
  seen.flags = RayFlags();
  seen.t = RayTCurrent();
}

void noteHit(inout Seen seen) {
  seen.end = 1;
  seen.closestHits += 1;
  seen.record = ordinal;
  seen.instanceIndex = InstanceIndex();
  seen.instanceID = InstanceID();
  seen.geometry = GeometryIndex();
  seen.primitive = PrimitiveIndex();
  seen.hitKind = HitKind();
  seen.flags = RayFlags();
  seen.t = RayTCurrent();
}

void noteCandidate(inout Seen seen) {
  seen.anyHits += 1;
  seen.anyRecord = ordinal;
  seen.anyT = RayTCurrent();
}

[shader("closesthit")]
void Closest(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  noteHit(seen);
  seen.barycentrics = attributes.barycentrics;
}

[shader("anyhit")]
void Count(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  noteCandidate(seen);
}

[shader("anyhit")]
void Ignore(inout Seen seen, BuiltInTriangleIntersectionAttributes attributes) {
  noteCandidate(seen);
  IgnoreHit();
}

[shader("intersection")]
void Boxed() {
  words.InterlockedAdd(kIntersectionCounter, 1u);
  BoxAttributes attributes;
  attributes.record = ordinal;
  attributes.t = RayTCurrent();
  ReportHit(reportedT, reportedKind, attributes);
}

[shader("closesthit")]
void BoxClosest(inout Seen seen, BoxAttributes attributes) {
  noteHit(seen);
  seen.boxRecord = attributes.record;
  seen.barycentrics.x = attributes.t;
}

[shader("anyhit")]
void BoxCount(inout Seen seen, BoxAttributes attributes) {
  noteCandidate(seen);
}

[shader("anyhit")]
void BoxIgnore(inout Seen seen, BoxAttributes attributes) {
  noteCandidate(seen);
  IgnoreHit();
}
