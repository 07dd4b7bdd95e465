// SPDX-License-Identifier: MIT
// FEATURE: compute QuadAll
// OPTIONS: -T lib_6_7
// EXPECT u32 0 0 0 0 0 1 1 1 1
// EXPECT u32 32 1 1 1 1 1 1 1 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = ((i < 4 ? 0x080B0205u : 0x04090107u) >> (8 * (i & 3)) & 255) + z;  // 5, 2, 11, 8, 7, 1, 9, 4
  results.Store(4 * i, QuadAll(v < 10));
  results.Store(32 + 4 * i, QuadAll(v < 12));
}
