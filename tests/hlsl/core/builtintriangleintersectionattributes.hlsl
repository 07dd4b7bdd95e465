// SPDX-License-Identifier: MIT
// FEATURE: core BuiltInTriangleIntersectionAttributes
// EXPECT f32 0 0.5
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("closesthit")]
void Hit(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes) {
  float3 bary = float3(1 - attributes.barycentrics.x - attributes.barycentrics.y,
                       attributes.barycentrics);
  payload.color.xyz = bary;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  BuiltInTriangleIntersectionAttributes attributes;
  attributes.barycentrics = float2(0.25, 0.5);
  results.Store(0, asuint(attributes.barycentrics.y));
}
