// SPDX-License-Identifier: MIT
// TRAP: 16 ReportHit may not return
// EXPECT f32 0 20
// EXPECT f32 4 0
// EXPECT u32 8 1
// EXPECT u32 12 1
// EXPECT u32 16 0
#include "scene.hlsli"

struct Attributes {
  float3 normal;
  uint id;
};

bool report(float t, uint id) {
  Attributes attributes = (Attributes)0;
  attributes.id = id;
  const bool accepted = ReportHit(t, 0, attributes);
  results.InterlockedAdd(16, 1u);
  return accepted;
}
[shader("intersection")]
void Box() {
  results.InterlockedAdd(12, 1u);
  report(19 + PrimitiveIndex(), 1);  // does not return: the ray takes the first hit
  results.InterlockedAdd(16, 10u);
  report(19, 2);
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Attributes attributes) {
  payload.color.x = RayTCurrent();
  payload.numbers.x = attributes.id;
}

[shader("raygeneration")]
void Main() {
  Payload payload =
      trace(RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH, 0xf0, test_ray(0));
  results.Store2(0, asuint(payload.color.xy));
  results.Store(8, payload.numbers.x);
}
