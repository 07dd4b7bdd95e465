// SPDX-License-Identifier: MIT
// FEATURE: core .SampleGrad
// EXPECT f32 0 2.0
// EXPECT f32 4 1.0
Texture2D<float4> image : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(image.SampleGrad(point_sampler, float2(0.3125, 0.0625), float2(0.01, 0), float2(0, 0.01)).x));
  results.Store(4, asuint(image.SampleGrad(point_sampler, float2(0.3125, 0.0625), float2(0.5, 0), float2(0, 0.5)).z));
}
