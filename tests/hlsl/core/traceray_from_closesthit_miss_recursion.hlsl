// SPDX-License-Identifier: MIT
// FEATURE: core TraceRay from closesthit/miss (recursion)
// EXPECT u32 0 20
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  if (payload.count < 3) {
    payload.count += 1;
    RayDesc ray = {WorldRayOrigin() + WorldRayDirection() * RayTCurrent(), 0.001,
                   reflect(WorldRayDirection(), float3(0, 1, 0)), 1000};
    TraceRay(scene, RAY_FLAG_NONE, 255, 0, 1, 0, ray, payload);
  }
}
[shader("miss")]
void Miss(inout Payload payload) {
  if (payload.count == 1000) {
    RayDesc ray = {WorldRayOrigin(), 0, WorldRayDirection(), 1};
    TraceRay(scene, RAY_FLAG_NONE, 255, 0, 1, 0, ray, payload);
  }
  payload.count += 20;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  Payload payload = (Payload)0;
  TraceRay(scene, RAY_FLAG_NONE, 255, 0, 1, 0, ray, payload);
  results.Store(0, payload.count);
}
