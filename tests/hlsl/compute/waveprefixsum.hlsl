// SPDX-License-Identifier: MIT
// FEATURE: compute WavePrefixSum
// EXPECT u32 0 0 5 7 18
// EXPECT u32 16 0 0 5 16
// EXPECT i32 32 0 -1 -5 0
// EXPECT f32 48 0 -0.5 -2.5 0.0
// EXPECT u32 64 0 0 5 8 7 13 18 27
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WavePrefixSum(v));
  if (i != 1) {
    results.Store(16 + 4 * i, WavePrefixSum(v));
  } else {
    results.Store(16 + 4 * i, WavePrefixSum(v + 100));
  }
  results.Store(32 + 4 * i, asuint(WavePrefixSum(int(v) - 6)));
  results.Store(48 + 4 * i, asuint(WavePrefixSum((float(v) - 6) * 0.5)));
  results.Store2(64 + 8 * i, WavePrefixSum(uint2(v, v + 3)));
}
