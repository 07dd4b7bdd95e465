// SPDX-License-Identifier: MIT
// FEATURE: extended .Sample
// EXPECT f32 0 2.0
// DXC is right to refuse it in this stage; --strict does too.
Texture2D<float4> image : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, asuint(image.Sample(point_sampler, float2(0.3125, 0.0625)).x));
}
