// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic PrimitiveIndex
// EXPECT u32 0 1
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.x = PrimitiveIndex();
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
