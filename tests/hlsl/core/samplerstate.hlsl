// SPDX-License-Identifier: MIT
// FEATURE: core SamplerState
// EXPECT f32 0 3.0
// EXPECT f32 4 5.0
Texture2D<float4> image : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store2(0, asuint(image.SampleLevel(point_sampler, float2(0.4375, 0.6875), 0).xy));
}
