// SPDX-License-Identifier: MIT
// FEATURE: core 3x4 * : mul(ObjectToWorld3x4(),…)
// EXPECT u32 0 1
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  float3 normal = float3(0, 1, 0);
  payload.color.xyz = mul(ObjectToWorld3x4(), float4(normal, 0));
  payload.color.xyz += mul((float3x3)ObjectToWorld3x4(), normal);
  payload.color.xyz += mul(normal, (float3x3)WorldToObject3x4());
  payload.color.xyz += mul(float4(normal, 1), ObjectToWorld4x3()).xyz;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
