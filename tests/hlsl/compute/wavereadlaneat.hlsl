// SPDX-License-Identifier: MIT
// FEATURE: compute WaveReadLaneAt
// EXPECT u32 0 11 11 11 11
// EXPECT u32 16 8 11 2 5
// EXPECT f32 32 2.5 -5.5 2.5 -5.5 2.5 -5.5 2.5 -5.5
// EXPECT u32 64 1 1 1 1
// EXPECT u32 80 5 8 5 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store(4 * i, WaveReadLaneAt(v, 2 + z));
  results.Store(16 + 4 * i, WaveReadLaneAt(v, 3 - i));
  results.Store2(32 + 8 * i, asuint(WaveReadLaneAt(float2(v * 0.5, v * -0.5 - 3), z)));
  results.Store(64 + 4 * i, WaveReadLaneAt(v == 8, 3));
  if (i & 1) {
    results.Store(80 + 4 * i, WaveReadLaneAt(v, 4 - i));
  } else {
    results.Store(80 + 4 * i, WaveReadLaneAt(v, z));
  }
}
