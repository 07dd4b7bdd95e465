// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic TraceRay
// EXPECT u32 0 0
// EXPECT u32 4 64
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.count = RayFlags();
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  Payload payloads[2] = (Payload[2])0;
  TraceRay(scene, RAY_FLAG_CULL_OPAQUE, 255, 0, 1, 0, ray, payloads[1]);
  results.Store2(0, uint2(payloads[0].count, payloads[1].count));
}
