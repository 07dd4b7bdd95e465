// SPDX-License-Identifier: MIT
// FEATURE: core SV_RayPayload/SV_IntersectionAttributes semantic
// EXPECT u32 0 1
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
[shader("miss")]
void Miss(inout Payload payload : SV_RayPayload) {
  payload.count = 2;
}
[shader("closesthit")]
void Hit(inout Payload payload : SV_RayPayload,
         BuiltInTriangleIntersectionAttributes attributes : SV_IntersectionAttributes) {
  payload.count = 1;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
