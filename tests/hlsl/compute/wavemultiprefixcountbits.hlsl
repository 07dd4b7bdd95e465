// SPDX-License-Identifier: MIT
// FEATURE: compute WaveMultiPrefixCountBits
// EXPECT u32 0 0 0 1 1
// EXPECT u32 16 77 0 0 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  const uint4 same = WaveMatch(v > 4 ? 1 : 0);
  results.Store(4 * i, WaveMultiPrefixCountBits(v != 11, same));
  if (i > 0) {
    results.Store(16 + 4 * i, WaveMultiPrefixCountBits(true, same));
  } else {
    results.Store(16 + 4 * i, 77);
  }
}
