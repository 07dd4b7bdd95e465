// SPDX-License-Identifier: MIT
// FEATURE: compute waves in loop steps and conditions
// EXPECT u32 0 2 0 2 0
// EXPECT u32 16 2 2 0 1
// EXPECT u32 32 1 1 1 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  uint n = z;
  for (uint k = 0; k < 6; k += WaveActiveCountBits(true)) {
    if (i & 1) continue;
    ++n;
  }
  results.Store(4 * i, n);

  n = z;
  for (uint j = i; j < 6; j += WaveActiveCountBits(true)) {
    if (i == 2) continue;
    ++n;
  }
  results.Store(16 + 4 * i, n);

  // The right side is evaluated by the lanes that need it: 0, 1 and 2.
  results.Store(32 + 4 * i, i < 3 && WaveActiveCountBits(true) == 3);
}
