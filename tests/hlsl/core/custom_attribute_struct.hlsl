// SPDX-License-Identifier: MIT
// FEATURE: core custom attribute struct
// EXPECT u32 0 1
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
struct Bary {
  float u;
  float v;
};
[shader("closesthit")]
void Hit(inout Payload payload, Bary bary) {
  payload.color.xy = float2(bary.u, bary.v);
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
