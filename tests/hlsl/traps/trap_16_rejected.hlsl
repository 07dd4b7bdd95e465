// SPDX-License-Identifier: MIT
// TRAP: 16
// EXPECT f32 0 19.5
// EXPECT f32 4 3
// EXPECT u32 16 5
// EXPECT u32 20 50
// EXPECT u32 32 1
// EXPECT u32 36 0
// EXPECT u32 40 0
// A rejected report leaves the committed hit and its attributes unchanged.
#include "scene.hlsli"

struct Attributes {
  uint id;
  uint4 more;
};

bool report(float t, uint kind, uint id) {
  Attributes a;
  a.id = id;
  a.more = id * 10;
  return ReportHit(t, kind, a);
}

[shader("intersection")]
void Box() {
  results.Store(32, report(19.5, 3, 5));
  results.Store(36, report(20, 4, 6));     // behind the committed hit
  results.Store(40, report(19.25, 9, 7));  // any-hit ignores it
}
[shader("anyhit")]
void BoxAny(inout Payload payload, Attributes attributes) {
  if (attributes.id == 7 && HitKind() == 9) IgnoreHit();
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Attributes attributes) {
  payload.color.xy = float2(RayTCurrent(), HitKind());
  payload.numbers.xy = uint2(attributes.id, attributes.more.w);
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 0xf0, test_ray(0)));
}
