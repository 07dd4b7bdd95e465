// SPDX-License-Identifier: MIT
// FEATURE: compute WaveGetLaneCount
// EXPECT u32 0 1 1 1 1
// EXPECT u32 16 1 1 1 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint count = WaveGetLaneCount() + z;
  results.Store(4 * i, count >= 4 && count <= 128);
  results.Store(16 + 4 * i, countbits(count));
}
