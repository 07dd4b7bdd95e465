// SPDX-License-Identifier: MIT
// Payload access qualifiers at HitObject::TraceRay and Invoke.
#include "common.hlsli"

struct [raypayload] Split {
  uint fromAnyHit : read(closesthit, miss) : write(anyhit);  // comes back in between
  uint toClosest : read(closesthit) : write(caller);
  uint answer : read(caller) : write(closesthit, miss);
};

[shader("anyhit")]
void NoteSplit(inout Split split, BuiltInTriangleIntersectionAttributes attributes) {
  split.fromAnyHit = 17;
}

[shader("closesthit")]
void AnswerSplit(inout Split split, BuiltInTriangleIntersectionAttributes attributes) {
  split.answer = split.fromAnyHit * 1000 + split.toClosest;
}

[shader("raygeneration")]
void TraceSplit() {
  const Ray ray = rays[0];
  Split split;
  split.toClosest = 1;
  const dx::HitObject hit = dx::HitObject::TraceRay(scene, ray.flags, ray.mask, 0, 1, 0,
                                                    describe(ray), split);
  words.Store(0, split.fromAnyHit);
  split.fromAnyHit += 5;
  split.toClosest = 2;
  dx::HitObject::Invoke(hit, split);
  words.Store(4, split.answer);
}
