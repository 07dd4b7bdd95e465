// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic AcceptHitAndEndSearch
// EXPECT u32 0 1
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.count += 1;
  AcceptHitAndEndSearch();
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
