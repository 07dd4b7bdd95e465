// SPDX-License-Identifier: MIT
// FEATURE: compute waves of matrices
// EXPECT f32 0 26 38 13 52 26 38 13 52 26 38 13 52 26 38 13 52
// EXPECT f32 64 0 0 0 0 5 8 2.5 10 7 13 3.5 14 18 27 9 36
// EXPECT u32 128 0 1 0 0 0 1 0 0 0 1 0 0 0 1 0 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  const float2x2 m = float2x2(v, v + 3, v * 0.5, v * 2);
  results.Store4(16 * i, asuint((float4)WaveActiveSum(m)));
  results.Store4(64 + 16 * i, asuint((float4)WavePrefixSum(m)));
  results.Store4(128 + 16 * i, uint4((bool4)WaveActiveAllEqual(float2x2(v, 2, v, v))));
}
