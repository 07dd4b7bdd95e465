// SPDX-License-Identifier: MIT
// TRAP: 22 payload access qualifiers are accepted
// OPTIONS: -T lib_6_7
// EXPECT u32 0 8
// EXPECT u32 4 4
// EXPECT u32 8 14
RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);
struct [raypayload] Payload {
  float a : read(caller) : write(caller, miss, closesthit);
  uint b : read(caller, anyhit, miss) : write(caller, miss);
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.b += 4;
  payload.a = 1;
}

uint shoot(uint start) {
  Payload payload = {0.0, start};
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  TraceRay(scene, 0, 255, 0, 0, 0, ray, payload);
  return payload.b;
}

[shader("raygeneration")]
void Main() {
  results.Store3(0, uint3(sizeof(Payload), shoot(0), shoot(10)));
}
