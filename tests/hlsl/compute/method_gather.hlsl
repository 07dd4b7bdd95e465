// SPDX-License-Identifier: MIT
// FEATURE: compute .Gather
// EXPECT f32 0 3.0
// EXPECT f32 4 4.0
// EXPECT f32 8 4.0
// EXPECT f32 12 3.0
// EXPECT f32 16 4.0
// EXPECT f32 20 4.0
// EXPECT f32 24 3.0
// EXPECT f32 28 3.0
Texture2D<float4> image : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, asuint(image.Gather(point_sampler, float2(0.5, 0.5))));
  results.Store4(16, asuint(image.GatherGreen(point_sampler, float2(0.5, 0.5))));
}
