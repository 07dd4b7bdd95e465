// SPDX-License-Identifier: MIT
// TRAP: 14 payloads of nested traces do not meet
// EXPECT u32 0 5
// EXPECT f32 4 66.0
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
struct Inner {
  float3 a;
  uint b;
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.count += 1;
}
void nested(inout Payload payload, uint depth) {
  Payload own = payload;
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 10};
  TraceRay(scene, 0, 255, 0, 0, 0, ray, own);
  payload.color.x += own.count * depth;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  Payload payload = {(float4)0, 5};
  nested(payload, 1);
  nested(payload, 10);
  results.Store(0, payload.count);
  results.Store(4, asuint(payload.color.x));
}
