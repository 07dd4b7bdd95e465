// SPDX-License-Identifier: MIT
// FEATURE: extended Texture1D
// EXPECT u32 0 1
Texture1D<float4> image : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  if (z == 1) {
    results.Store4(16, asuint(image.Load(int2(1, 0)) + image.SampleLevel(point_sampler, 0.5, 0)));
  }
  results.Store(0, 1);
}
