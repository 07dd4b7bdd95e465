// SPDX-License-Identifier: MIT
// FEATURE: core TextureCube
// EXPECT u32 0 1
TextureCube<float4> sky : register(t0);
SamplerState linear_sampler : register(s0);
float4 look(float3 direction) {
  return sky.SampleLevel(linear_sampler, direction, 0);
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  if (z == 1) {
    results.Store4(16, asuint(look(float3(0, 1, 0))));
  }
  results.Store(0, 1);
}
