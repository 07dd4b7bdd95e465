// SPDX-License-Identifier: MIT
// FEATURE: extended Texture3D
// EXPECT f32 0 1
// EXPECT f32 4 2
// EXPECT f32 8 0
// EXPECT f32 12 1
// EXPECT f32 16 3
// EXPECT f32 20 2
// EXPECT f32 24 1
// EXPECT f32 28 0
// EXPECT f32 32 6
// EXPECT f32 36 1
// EXPECT f32 40 0
// EXPECT f32 44 1
// EXPECT f32 48 6
// EXPECT f32 52 1
// EXPECT f32 56 0
// EXPECT f32 60 0
// EXPECT f32 64 0
// EXPECT f32 68 0
// EXPECT f32 72 0
// EXPECT f32 76 0
// EXPECT u32 80 8
// EXPECT u32 84 8
// EXPECT u32 88 2
Texture3D<float4> volume_3d : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, asuint(volume_3d.Load(int4(1, 2, 1, 0))));
  results.Store4(16, asuint(volume_3d.Load(int4(3, 2, 0, 1))));
  results.Store4(32, asuint(volume_3d.SampleLevel(point_sampler, float3(0.8125, 0.1875, 0.75), 0)));
  results.Store4(48, asuint(volume_3d.SampleLevel(point_sampler, float3(0.8125, 0.1875, -1), 0)));
  results.Store4(64, asuint(volume_3d[uint3(0, 0, 2)]));
  uint width, height, depth;
  volume_3d.GetDimensions(width, height, depth);
  results.Store3(80, uint3(width, height, depth));
}
