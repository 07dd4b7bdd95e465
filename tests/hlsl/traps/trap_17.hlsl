// SPDX-License-Identifier: MIT
// TRAP: 17 triangle attributes in an own struct
// EXPECT u32 0 32
RaytracingAccelerationStructure scene : register(t0);
struct Payload {
  float4 color;
  uint count;
};
struct Own {
  float u;
  float v;
};
struct Big {
  float3 normal;
  uint id;
  float2 uv[2];
};
[shader("closesthit")]
void Hit(inout Payload payload, Own own) {
  payload.color.x = 1 - own.u - own.v;
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Big big) {
  payload.color.xyz = big.normal * big.uv[1].y;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, sizeof(Big));
}
