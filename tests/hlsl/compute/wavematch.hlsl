// SPDX-License-Identifier: MIT
// FEATURE: compute WaveMatch
// EXPECT u32 0 13 0 0 0 2 0 0 0 13 0 0 0 13 0 0 0
// EXPECT u32 64 5 2 5 8
// EXPECT u32 80 1 10 4 10
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store4(16 * i, WaveMatch(v > 4 ? 7.5 : 1.5));
  results.Store(64 + 4 * i, WaveMatch(uint2(v & 1, v == 8)).x);
  if (i & 1) {
    results.Store(80 + 4 * i, WaveMatch(9 + z).x);
  } else {
    results.Store(80 + 4 * i, WaveMatch(v).x);
  }
}
