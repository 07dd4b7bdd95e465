// SPDX-License-Identifier: MIT
// FEATURE: core bit fields in payloads and callable data
// EXPECT u32 0 0x00500A03
// EXPECT u32 4 77
// EXPECT u32 8 5
// EXPECT i32 12 -2
RaytracingAccelerationStructure scene : register(t0);
RWByteAddressBuffer results : register(u0);

struct Payload {
  uint depth : 8;
  uint flags : 8;
  uint material : 16;
  uint64_t key : 63;
  int sign : 2;
};

[shader("miss")]
void Miss(inout Payload payload) {
  payload.flags |= 8;
  payload.material = payload.depth + 77;
  payload.key = 5;
  payload.sign = 2;
}

[shader("raygeneration")]
void Main() {
  Payload payload = {3, 2, 0, 0, 0};
  const RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  TraceRay(scene, 0, 255, 0, 0, 0, ray, payload);
  results.Store(0, payload.depth | payload.flags << 8 | payload.material << 16);
  results.Store(4, payload.material - payload.depth);
  results.Store(8, (uint)payload.key);
  results.Store(12, payload.sign);
}
