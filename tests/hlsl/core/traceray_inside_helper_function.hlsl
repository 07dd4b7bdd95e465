// SPDX-License-Identifier: MIT
// FEATURE: core TraceRay inside helper function
// EXPECT u32 0 11
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.count = 9;
}
uint shoot(float3 origin, uint start) {
  RayDesc ray;
  ray.Origin = origin;
  ray.TMin = 0;
  ray.Direction = float3(0, 1, 0);
  ray.TMax = 10;
  Payload payload;
  payload.color = 0;
  payload.count = start;
  TraceRay(scene, RAY_FLAG_NONE, ~0, 0, 1, 0, ray, payload);
  return payload.count + start;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, shoot(float3(0, 0, 0), 2));
}
