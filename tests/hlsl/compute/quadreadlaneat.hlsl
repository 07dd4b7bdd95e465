// SPDX-License-Identifier: MIT
// FEATURE: compute QuadReadLaneAt
// EXPECT u32 0 2 2 2 2 1 1 1 1
// EXPECT f32 32 4.0 9 4.0 9 4.0 9 4.0 9 2.0 5 2.0 5 2.0 5 2.0 5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = ((i < 4 ? 0x080B0205u : 0x04090107u) >> (8 * (i & 3)) & 255) + z;  // 5, 2, 11, 8, 7, 1, 9, 4
  results.Store(4 * i, QuadReadLaneAt(v, 1));
  results.Store2(32 + 8 * i, asuint(QuadReadLaneAt(float2(v * 0.5, v + 1), 3)));
}
