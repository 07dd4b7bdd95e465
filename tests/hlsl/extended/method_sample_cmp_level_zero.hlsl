// SPDX-License-Identifier: MIT
// FEATURE: extended .SampleCmpLevelZero
// EXPECT f32 0 1.0
Texture2D<float> depth : register(t0);
SamplerComparisonState compare : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, asuint(depth.SampleCmpLevelZero(compare, float2(0.9375, 0.5), 6.5)));
}
