// SPDX-License-Identifier: MIT
// FEATURE: compute QuadAny
// OPTIONS: -T lib_6_7
// EXPECT u32 0 1 1 1 1 0 0 0 0
// EXPECT u32 32 0 0 0 0 0 0 0 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = ((i < 4 ? 0x080B0205u : 0x04090107u) >> (8 * (i & 3)) & 255) + z;  // 5, 2, 11, 8, 7, 1, 9, 4
  results.Store(4 * i, QuadAny(v == 11));
  results.Store(32 + 4 * i, QuadAny(v == 12));
}
