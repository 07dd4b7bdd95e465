// SPDX-License-Identifier: MIT
// FEATURE: extended Texture1D
// EXPECT f32 0 3
// EXPECT f32 4 0
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT f32 16 2
// EXPECT f32 20 0
// EXPECT f32 24 1
// EXPECT f32 28 0
// EXPECT f32 32 6
// EXPECT f32 36 0
// EXPECT f32 40 0
// EXPECT f32 44 0
// EXPECT f32 48 5
// EXPECT f32 52 0
// EXPECT f32 56 0
// EXPECT f32 60 0
// EXPECT u32 64 8
Texture1D<float4> line_1d : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, asuint(line_1d.Load(int2(3, 0))));
  results.Store4(16, asuint(line_1d.Load(int2(2, 1))));
  results.Store4(32, asuint(line_1d.SampleLevel(point_sampler, 0.8125, 0)));
  results.Store2(48, asuint(float2(line_1d[5].x, line_1d[8].x)));
  results.Store2(56, asuint(line_1d.Load(int2(-1, 0)).xy));
  uint width;
  line_1d.GetDimensions(width);
  results.Store(64, width);
}
