// SPDX-License-Identifier: MIT
// FEATURE: compute WaveGetLaneIndex
// EXPECT u32 0 0 1 2 3
// EXPECT u32 16 3 4 5 6
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  results.Store(4 * i, WaveGetLaneIndex() + z);
  const uint own = WaveGetLaneIndex() + 3;
  if (i & 1) {
    results.Store(16 + 4 * WaveGetLaneIndex(), own);
  } else {
    results.Store(16 + 4 * i, WaveGetLaneIndex() + 3);
  }
}
