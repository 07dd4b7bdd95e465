// SPDX-License-Identifier: MIT
// FEATURE: compute QuadReadAcrossY
// EXPECT u32 0 11 8 5 2 9 4 7 1
// EXPECT f32 32 5.5 12 4.0 9 2.5 6 1.0 3 4.5 10 2.0 5 3.5 8 0.5 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = ((i < 4 ? 0x080B0205u : 0x04090107u) >> (8 * (i & 3)) & 255) + z;  // 5, 2, 11, 8, 7, 1, 9, 4
  results.Store(4 * i, QuadReadAcrossY(v));
  results.Store2(32 + 8 * i, asuint(QuadReadAcrossY(float2(v * 0.5, v + 1))));
}
