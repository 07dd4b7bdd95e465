// SPDX-License-Identifier: MIT
// FEATURE: core miss
// EXPECT u32 0 5
// EXPECT f32 4 1.0
// EXPECT f32 8 100.0
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.color = float4(WorldRayDirection(), RayTCurrent());
  payload.count += 1;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(1, 2, 3), 0.5, float3(0, 0, 1), 100};
  Payload payload = {(float4)0, 4};
  TraceRay(scene, RAY_FLAG_NONE, 0xff, 0, 1, 0, ray, payload);
  results.Store(0, payload.count);
  results.Store2(4, asuint(payload.color.zw));
}
