// SPDX-License-Identifier: MIT
// FEATURE: compute waves after lanes have returned
// EXPECT u32 0 7 15 15 15
// EXPECT u32 16 0 13 13 13
// EXPECT u32 32 0 0 19 19
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  if (i == 0) {
    results.Store(0, WaveActiveSum(v) + 2);
    return;
  }
  results.Store(4 * i, WaveActiveSum(v) - 6);
  if (WaveIsFirstLane()) {
    results.Store(16 + 4 * i, WaveActiveMax(v) + 11);
  } else {
    results.Store(16 + 4 * i, WaveReadLaneFirst(v) + 2);
  }
  if (v == 2) return;
  results.Store(32 + 4 * i, WaveActiveSum(v));
}
