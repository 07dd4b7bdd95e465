// SPDX-License-Identifier: MIT
// FEATURE: extended SamplerComparisonState
// EXPECT f32 0 1.0
// EXPECT f32 4 0.0
Texture2D<float> depth : register(t0);
SamplerComparisonState compare : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, asuint(depth.SampleCmpLevelZero(compare, float2(0.4375, 0.5), 2.0)));
  results.Store(4, asuint(depth.SampleCmpLevelZero(compare, float2(0.4375, 0.5), 4.0)));
}
