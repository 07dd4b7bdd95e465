// SPDX-License-Identifier: MIT
// FEATURE: compute waves in loops
// EXPECT u32 0 2220 203 2023 3
// EXPECT u32 16 3 3 3 3
// EXPECT u32 32 4 7 9 10
// EXPECT u32 48 0 6 10 12
// EXPECT u32 64 4 4 4 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  uint sum = z;
  uint factor = 1;
  for (uint k = 0; k < 4; ++k) {
    const uint place = factor;
    factor *= 10;
    if (i == k) continue;
    if (i + k == 4) break;
    sum += WaveActiveSum(place);
  }
  results.Store(4 * i, sum);

  uint n = z;
  while (WaveActiveAnyTrue(n < i)) ++n;
  results.Store(16 + 4 * i, n);

  uint count = z;
  uint left = i + 1;
  do {
    count += WaveActiveCountBits(true);
  } while (--left != 0);
  results.Store(32 + 4 * i, count);

  uint inner = z;
  for (uint a = 0; a < i; ++a) {
    for (uint b = 0; b < 2; ++b) inner += WaveActiveCountBits(true);
  }
  results.Store(48 + 4 * i, inner);
  results.Store(64 + 4 * i, WaveActiveCountBits(true));  // together again
}
