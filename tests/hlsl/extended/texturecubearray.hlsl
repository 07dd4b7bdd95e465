// SPDX-License-Identifier: MIT
// FEATURE: extended TextureCubeArray
// EXPECT f32 0 4
// EXPECT f32 4 2
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT f32 16 4
// EXPECT f32 20 2
// EXPECT f32 24 0
// EXPECT f32 28 6
// EXPECT f32 32 1
// EXPECT f32 36 5
// EXPECT f32 40 0
// EXPECT f32 44 11
// EXPECT f32 48 1
// EXPECT f32 52 5
// EXPECT f32 56 0
// EXPECT f32 60 11
TextureCubeArray<float4> skies_cube_array : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const float3 right = float3(1, 0.375, -0.125);
  const float3 back = float3(0.625, -0.375, -1);
  results.Store4(0, asuint(skies_cube_array.SampleLevel(point_sampler, float4(right, 0), 0)));
  results.Store4(16, asuint(skies_cube_array.SampleLevel(point_sampler, float4(right, 1), 0)));
  results.Store4(32, asuint(skies_cube_array.SampleLevel(point_sampler, float4(back, 1), 0)));
  results.Store4(48, asuint(skies_cube_array.SampleLevel(point_sampler, float4(back, 7), 0)));
}
