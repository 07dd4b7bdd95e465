// SPDX-License-Identifier: MIT
// FEATURE: core custom attribute struct
// EXPECT f32 0 0.5 4
// EXPECT f32 4 0.25 4
// EXPECT f32 8 0
// EXPECT f32 12 0
#include "scene.hlsli"

struct Bary {
  float u;
  float v;
};
[shader("closesthit")]
void Hit(inout Payload payload, Bary bary) {
  payload.color.xy = float2(bary.u, bary.v);
}

[shader("raygeneration")]
void Main() {
  store(0, trace(RAY_FLAG_NONE, 0xff, test_ray(0)));
}
