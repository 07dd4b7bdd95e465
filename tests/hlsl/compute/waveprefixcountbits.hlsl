// SPDX-License-Identifier: MIT
// FEATURE: compute WavePrefixCountBits
// EXPECT u32 0 0 1 1 2
// EXPECT u32 16 0 0 1 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WavePrefixCountBits(v >= 5));
  if (i & 1) {
    results.Store(16 + 4 * i, WavePrefixCountBits(v == 2));
  } else {
    results.Store(16 + 4 * i, WavePrefixCountBits(true));
  }
}
