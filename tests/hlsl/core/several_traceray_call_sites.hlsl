// SPDX-License-Identifier: MIT
// FEATURE: core >1 TraceRay call sites
// EXPECT u32 0 3
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.count = payload.count * 2 + 1;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  Payload payload = (Payload)0;
  TraceRay(scene, RAY_FLAG_NONE, 255, 0, 1, 0, ray, payload);
  ray.Direction = float3(1, 0, 0);
  TraceRay(scene, RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH, 255, 0, 1, 0, ray, payload);
  results.Store(0, payload.count);
}
