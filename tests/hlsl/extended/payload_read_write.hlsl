// SPDX-License-Identifier: MIT
// FEATURE: extended : read(...) : write(...)
// OPTIONS: -T lib_6_7
// EXPECT u32 0 7
// EXPECT f32 4 0.5
RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);
struct [raypayload] Payload {
  float a : read(caller) : write(caller, miss, closesthit);
  uint b : read(caller, anyhit, miss) : write(caller, miss);
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.b += 4;
  payload.a = 0.5;
}

[shader("raygeneration")]
void Main() {
  Payload payload = {0.0, 3};
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  TraceRay(scene, 0, 255, 0, 0, 0, ray, payload);
  results.Store(0, payload.b);
  results.Store(4, asuint(payload.a));
}
