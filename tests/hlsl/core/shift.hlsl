// SPDX-License-Identifier: MIT
// FEATURE: core shift <<,>>
// EXPECT u32 0 2
// EXPECT u32 4 1
// EXPECT u32 8 4294967295
// EXPECT u32 12 16
// EXPECT u32 16 4
// EXPECT u32 20 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint a = 0x80000001 + z;
  int b = (int)a;
  results.Store4(0, uint4(a << 1, a >> 31, b >> 31, 1u << 4));
  uint2 c = uint2(1, 2);
  c <<= 3;
  c >>= uint2(1, 2);
  results.Store2(16, c);
}
