// SPDX-License-Identifier: MIT
// FEATURE: core RaytracingAccelerationStructure
// EXPECT u32 0 3
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.count = 3;
}
void shoot(RaytracingAccelerationStructure where, inout Payload payload) {
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  TraceRay(where, 0, 255, 0, 0, 0, ray, payload);
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  Payload payload = (Payload)0;
  shoot(scene, payload);
  results.Store(0, payload.count);
}
