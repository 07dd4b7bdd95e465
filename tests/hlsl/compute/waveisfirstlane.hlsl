// SPDX-License-Identifier: MIT
// FEATURE: compute WaveIsFirstLane
// EXPECT u32 0 1 0 0 0
// EXPECT u32 16 1 1 0 0
// EXPECT u32 32 0 0 1 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  results.Store(4 * i, WaveIsFirstLane());
  if ((i + z) & 1) {
    results.Store(16 + 4 * i, WaveIsFirstLane());
  } else {
    results.Store(16 + 4 * i, WaveIsFirstLane());
  }
  if (i + z >= 2 && WaveIsFirstLane()) results.Store(32 + 4 * i, 1);
}
