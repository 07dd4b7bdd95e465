// SPDX-License-Identifier: MIT
// FEATURE: extended TextureCubeArray
// EXPECT u32 0 1
TextureCubeArray<float4> skies : register(t0);
SamplerState point_sampler : register(s0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  if (z == 1) {
    results.Store(4, asuint(skies.SampleLevel(point_sampler, float4(0, 1, 0, 1), 0).x));
  }
  results.Store(0, 1);
}
