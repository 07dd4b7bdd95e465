// SPDX-License-Identifier: MIT
// FEATURE: core TextureCube
// EXPECT f32 0 4
// EXPECT f32 4 2
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT f32 16 6
// EXPECT f32 20 2
// EXPECT f32 24 0
// EXPECT f32 28 1
// EXPECT f32 32 5
// EXPECT f32 36 1
// EXPECT f32 40 0
// EXPECT f32 44 2
// EXPECT f32 48 5
// EXPECT f32 52 6
// EXPECT f32 56 0
// EXPECT f32 60 3
// EXPECT f32 64 0
// EXPECT f32 68 0
// EXPECT f32 72 0
// EXPECT f32 76 4
// EXPECT f32 80 1
// EXPECT f32 84 5
// EXPECT f32 88 0
// EXPECT f32 92 5
// EXPECT f32 96 2
// EXPECT f32 100 1
// EXPECT f32 104 1
// EXPECT f32 108 0
TextureCube<float4> sky_cube : register(t0);
SamplerState point_sampler : register(s0);
float4 look(float3 direction, float mip) {
  return sky_cube.SampleLevel(point_sampler, direction, mip);
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const float3 directions[6] = {float3(1, 0.375, -0.125), float3(-1, 0.375, 0.625),
                                float3(0.375, 1, -0.625), float3(0.375, -1, -0.625),
                                float3(-0.875, 0.875, 1), float3(0.625, -0.375, -1)};
  for (uint face = 0; face < 6; ++face) {
    results.Store4(16 * face, asuint(look(directions[face], 0)));
  }
  results.Store4(96, asuint(look(2 * directions[0], 1)));
}
