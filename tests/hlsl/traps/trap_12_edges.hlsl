// SPDX-License-Identifier: MIT
// TRAP: 12 textures with separate samplers
// EXPECT f32 0 4
// EXPECT f32 4 6
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT f32 16 3
// EXPECT f32 20 5
// EXPECT f32 24 0
// EXPECT f32 28 0
// EXPECT f32 32 0
// EXPECT f32 36 0
// EXPECT f32 40 2
// EXPECT f32 44 3
// EXPECT f32 48 1
// EXPECT f32 52 0
// EXPECT f32 56 2
// EXPECT f32 60 3
// EXPECT f32 64 1
// EXPECT f32 68 7
// EXPECT f32 72 0
// EXPECT f32 76 3
// EXPECT f32 80 3
// EXPECT f32 84 4
// EXPECT f32 88 4
Texture2D<float4> a : register(t0);
Texture2D<float2> b : register(t1);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, asuint(a.SampleLevel(point_sampler, float2(0.3125, 0.8125), 0, int2(2, 0))));
  results.Store2(16, asuint(b.Load(int3(5, 6, 0), int2(-2, -1))));
  results.Store4(24, asuint(a.Load(int3(8, 0, 0)) + a.Load(int3(0, 4, 1)) + a.Load(int3(0, 0, 2)) + a.Load(int3(-1, 0, 0))));
  results.Store4(40, asuint(a.SampleLevel(point_sampler, float2(0.6, 0.8), 0.75)));  // mip 1 is nearer
  results.Store3(56, asuint(a.SampleLevel(point_sampler, float2(0.6, 0.8), 9).xyz));
  results.Store2(68, asuint(a.SampleLevel(point_sampler, float2(5, -5), 0).xy));
  results.Store4(76, asuint(a.GatherGreen(point_sampler, float2(0.5, 0.5)).wzyx));
}
