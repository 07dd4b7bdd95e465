// SPDX-License-Identifier: MIT
// TRAP: 17 attributes in own structs
// BREAKS: KA0412
// EXPECT f32 0 0.25 8
// EXPECT f32 4 0.5 4
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT u32 16 32
// EXPECT f32 36 2.5
// EXPECT f32 40 3.5
// EXPECT f32 44 -2
// EXPECT f32 48 0.0625
// EXPECT u32 52 6
// EXPECT u32 56 0
// EXPECT u32 60 0
// EXPECT u32 64 0
#include "scene.hlsli"

struct Inner {
  float u;
};
struct Own {
  Inner inner;
  float v;
};
struct Big {
  float3 normal;
  uint id;
  float2 uv[2];
};
// The same 32 bytes, declared in another way.
struct BigToo {
  float4 normal_and_id;
  row_major float2x2 uv;
};
[shader("closesthit")]
void Hit(inout Payload payload, Own own) {
  payload.color.xy = float2(1 - own.inner.u - own.v, own.inner.u);
}
[shader("intersection")]
void Box() {
  Big big = {float3(1, 2, -2), 6, {float2(0.5, 0.25), float2(1.5, 0.0625)}};
  ReportHit(19, 0, big);
}
[shader("anyhit")]
void BoxAny(inout Payload payload, BigToo big) {
  payload.color.xy = float2(big.normal_and_id.y + big.uv[0].x, big.normal_and_id.y + big.uv[1].x);
}
[shader("closesthit")]
void BoxHit(inout Payload payload, Big big) {
  payload.color.zw = float2(big.normal.z, big.uv[1].y);
  payload.numbers.x = big.id;
}

[shader("raygeneration")]
void Main() {
  results.Store4(0, asuint(trace(RAY_FLAG_NONE, 0x0f, test_ray(0)).color));
  results.Store(16, sizeof(Big));
  store(36, trace(RAY_FLAG_NONE, 0xf0, test_ray(0)));
}
