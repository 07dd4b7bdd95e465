// SPDX-License-Identifier: MIT
// FEATURE: compute WaveReadLaneFirst
// EXPECT u32 0 5 5 5 5
// EXPECT u32 16 5 2 5 2
// EXPECT f32 32 2.5 8 2.5 8 2.5 8 2.5 8
// EXPECT u32 64 1 1 1 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WaveReadLaneFirst(v));
  if (i & 1) {
    results.Store(16 + 4 * i, WaveReadLaneFirst(v));
  } else {
    results.Store(16 + 4 * i, WaveReadLaneFirst(v));
  }
  results.Store2(32 + 8 * i, asuint(WaveReadLaneFirst(float2(v * 0.5, v + 3))));
  results.Store(64 + 4 * i, WaveReadLaneFirst(v == 5));
}
