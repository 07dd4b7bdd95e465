// SPDX-License-Identifier: MIT
// TRAP: 16
// EXPECT u32 0 1
// EXPECT u32 4 77
// EXPECT u32 8 77
// EXPECT f32 16 20
// EXPECT f32 20 3
// EXPECT u32 32 5
// EXPECT f32 48 20
// EXPECT u32 64 7
// ReportHit does not return when the hit ends the search, through AcceptHitAndEndSearch in any-hit
// or RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH; nothing nearer is found afterwards.
#include "scene.hlsli"

struct Attributes {
  uint id;
  bool ends;
};

bool report(float t, uint kind, uint id) {
  Attributes a = {id, true};
  return ReportHit(t, kind, a);
}

[shader("intersection")]
void Box() {
  results.Store(0, 1);
  results.Store(4, 77);
  results.Store(8, 77);
  const bool accepted = report(20, 3, RayFlags() == 0 ? 5 : 7);
  results.Store(4, accepted ? 1 : 2);
  report(19.5, 4, 6);
  results.Store(8, 1);
}
[shader("anyhit")]
void BoxAny(inout Payload payload, Attributes attributes) {
  if (attributes.ends) AcceptHitAndEndSearch();
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Attributes attributes) {
  payload.color.xy = float2(RayTCurrent(), HitKind());
  payload.numbers.x = attributes.id;
}

[shader("raygeneration")]
void Main() {
  store(16, trace(RAY_FLAG_NONE, 0xf0, test_ray(0)));
  const uint flags = RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_FORCE_OPAQUE;
  store(48, trace(flags, 0xf0, test_ray(0)));
}
