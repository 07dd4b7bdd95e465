// SPDX-License-Identifier: MIT
// FEATURE: core .SampleLevel
// EXPECT f32 0 2.0
// EXPECT f32 4 0.0
// EXPECT f32 8 0.0
// EXPECT f32 12 0.0
// EXPECT f32 16 1.0
// EXPECT f32 20 3.0
Texture2D<float4> image : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, asuint(image.SampleLevel(point_sampler, float2(0.3125, 0.0625), 0)));
  results.Store(16, asuint(image.SampleLevel(point_sampler, float2(0.625, 0.625), 1).z));
  results.Store(20, asuint(image.SampleLevel(point_sampler, float2(0.3125, 0.0625), 0, int2(1, 0)).x));
}
