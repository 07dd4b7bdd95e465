// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic ReportHit
// EXPECT f32 0 19.25
// EXPECT f32 4 5
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT u32 16 5
// EXPECT u32 20 0
// EXPECT u32 24 0
// EXPECT u32 28 0
// EXPECT u32 32 0
// EXPECT u32 36 1
// EXPECT u32 40 0
// EXPECT u32 44 0
// EXPECT u32 48 1
// EXPECT f32 52 100
// EXPECT f32 56 19.5
// EXPECT f32 60 19.5
// EXPECT f32 64 19.25
#include "scene.hlsli"

struct Attributes {
  float3 normal;
  uint id;
};

[shader("intersection")]
void Box() {
  Attributes a = (Attributes)0;
  const float before = RayTCurrent();
  a.id = 1;
  results.Store(32, ReportHit(200, 1, a));  // behind TMax
  a.id = 3;
  results.Store(36, ReportHit(19.5, 3, a));
  const float first = RayTCurrent();
  a.id = 4;
  results.Store(40, ReportHit(20, 4, a));  // behind the committed hit
  a.id = 6;
  results.Store(44, ReportHit(19.125, 6, a));  // ignored by any-hit
  const float second = RayTCurrent();
  a.id = 5;
  results.Store(48, ReportHit(19.25, 5, a));
  a.id = 7;  // each call has its own attributes
  results.Store4(52, asuint(float4(before, first, second, RayTCurrent())));
}
[shader("anyhit")]
void BoxAny(inout Payload payload, Attributes attributes) {
  if (HitKind() == 6) IgnoreHit();
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Attributes attributes) {
  payload.color.xy = float2(RayTCurrent(), HitKind());
  payload.numbers.x = attributes.id;
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 0xf0, test_ray(0)));
}
