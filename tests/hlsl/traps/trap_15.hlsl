// SPDX-License-Identifier: MIT
// TRAP: 15 IgnoreHit ends the shader from any depth
// EXPECT u32 0 1
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
bool inner(inout uint count) {
  count += 1;
  if (count > 2) IgnoreHit();
  return true;
}
uint outer(inout Payload payload) {
  return inner(payload.count) ? 10 : 20;
}
[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.color.x = 1;
  payload.color.y = outer(payload) + outer(payload);
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
