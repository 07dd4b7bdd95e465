// SPDX-License-Identifier: MIT
// FEATURE: compute QuadReadAcrossDiagonal
// EXPECT u32 0 8 11 2 5 4 9 1 7
// EXPECT f32 32 4.0 9 5.5 12 1.0 3 2.5 6 2.0 5 4.5 10 0.5 2 3.5 8
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = ((i < 4 ? 0x080B0205u : 0x04090107u) >> (8 * (i & 3)) & 255) + z;  // 5, 2, 11, 8, 7, 1, 9, 4
  results.Store(4 * i, QuadReadAcrossDiagonal(v));
  results.Store2(32 + 8 * i, asuint(QuadReadAcrossDiagonal(float2(v * 0.5, v + 1))));
}
