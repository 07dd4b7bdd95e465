// SPDX-License-Identifier: MIT
// FEATURE: extended Texture2DArray
// EXPECT f32 0 1
// EXPECT f32 4 2
// EXPECT f32 8 1
// EXPECT f32 12 1
// EXPECT f32 16 6
// EXPECT f32 20 1
// EXPECT f32 24 0
// EXPECT f32 28 1
// EXPECT f32 32 6
// EXPECT f32 36 1
// EXPECT f32 40 0
// EXPECT f32 44 0
// EXPECT f32 48 3
// EXPECT f32 52 4
// EXPECT f32 56 0
// EXPECT f32 60 1
// EXPECT f32 64 0
// EXPECT f32 68 0
// EXPECT f32 72 0
// EXPECT f32 76 0
// EXPECT u32 80 8
// EXPECT u32 84 8
// EXPECT u32 88 2
Texture2DArray<float4> layers_array : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, asuint(layers_array.Load(int4(1, 2, 1, 1))));
  results.Store4(16, asuint(layers_array.SampleLevel(point_sampler, float3(0.8125, 0.1875, 1), 0)));
  results.Store4(32, asuint(layers_array.SampleLevel(point_sampler, float3(0.8125, 0.1875, -3), 0)));
  results.Store4(48, asuint(layers_array[uint3(3, 4, 1)]));
  results.Store4(64, asuint(layers_array[uint3(3, 4, 2)]));
  uint width, height, elements;
  layers_array.GetDimensions(width, height, elements);
  results.Store3(80, uint3(width, height, elements));
}
