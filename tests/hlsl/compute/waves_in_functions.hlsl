// SPDX-License-Identifier: MIT
// FEATURE: compute waves in functions
// EXPECT u32 0 5 5 111 111
// EXPECT u32 16 2 21 31 2
// EXPECT u32 32 4 4 4 4
// EXPECT u32 48 3 3 105 3
RWByteAddressBuffer results : register(u0);

uint first_of(uint x) {
  if (x > 6) return WaveReadLaneFirst(x) + 100;
  return WaveReadLaneFirst(x);
}
uint steps(uint x) {
  uint out_count = 0;
  for (uint k = 0; k < 3; ++k) {
    if (x % 3 == k) return out_count * 10 + WaveActiveCountBits(true);
    out_count += WaveActiveCountBits(true);
  }
  return 1000;
}

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, first_of(v));
  results.Store(16 + 4 * i, steps(i));
  results.Store(32 + 4 * i, WaveActiveCountBits(true));
  if (i == 2) {
    results.Store(48 + 4 * i, first_of(v) - 6);
  } else {
    results.Store(48 + 4 * i, WaveActiveCountBits(first_of(i) == 0));
  }
}
