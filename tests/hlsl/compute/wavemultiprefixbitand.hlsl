// SPDX-License-Identifier: MIT
// FEATURE: compute WaveMultiPrefixBitAnd
// EXPECT u32 0 4294967295 4294967295 5 1
// EXPECT u32 16 77 4294967295 4294967295 11
// EXPECT u32 32 4294967295 4294967295 4294967295 4294967295 5 8 1 8
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  const uint4 same = WaveMatch(v > 4 ? 1 : 0);
  results.Store(4 * i, WaveMultiPrefixBitAnd(v, same));
  if (i > 0) {
    results.Store(16 + 4 * i, WaveMultiPrefixBitAnd(v, same));
  } else {
    results.Store(16 + 4 * i, 77);
  }
  results.Store2(32 + 8 * i, WaveMultiPrefixBitAnd(uint2(v, v + 3), same));
}
