// SPDX-License-Identifier: MIT
// FEATURE: extended payload access qualifiers [raypayload]
// OPTIONS: -T lib_6_7
// EXPECT u32 0 4
RaytracingAccelerationStructure scene : register(t0);
struct [raypayload] Payload {
  float a : read(caller) : write(caller, miss, closesthit);
  uint b : read(caller, anyhit) : write(caller, miss);
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.b = 4;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  Payload payload = {1, 2};
  TraceRay(scene, 0, 255, 0, 0, 0, ray, payload);
  results.Store(0, payload.b);
}
