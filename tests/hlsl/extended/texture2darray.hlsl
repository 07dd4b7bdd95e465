// SPDX-License-Identifier: MIT
// FEATURE: extended Texture2DArray
// EXPECT u32 0 1
Texture2DArray<float4> image : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  if (z == 1) {
    results.Store4(16, asuint(image.Load(int4(1, 2, 1, 0)) + image.SampleLevel(point_sampler, float3(0, 0, 1), 0)));
  }
  results.Store(0, 1);
}
