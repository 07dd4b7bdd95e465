// SPDX-License-Identifier: MIT
// FEATURE: core >1 payload struct types in one library
// EXPECT u32 0 1
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
struct Shadow {
  bool visible;
};
[shader("miss")]
void Miss(inout Shadow payload) {
  payload.visible = true;
}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.count = 1;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  Shadow shadow = {false};
  TraceRay(scene, RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 255, 0, 1, 0, ray, shadow);
  results.Store(0, shadow.visible);
}
