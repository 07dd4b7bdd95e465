// SPDX-License-Identifier: MIT
// FEATURE: core IgnoreHit/AcceptHit inside helper function
// EXPECT u32 0 1
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
void decide(float u) {
  if (u < 0.25) IgnoreHit();
  if (u > 0.75) AcceptHitAndEndSearch();
}
[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  decide(attributes.barycentrics.x);
  payload.count += 1;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
