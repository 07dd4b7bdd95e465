// SPDX-License-Identifier: MIT
// FEATURE: core bitwise &,|,^,~
// EXPECT u32 0 48
// EXPECT u32 4 255
// EXPECT u32 8 15
// EXPECT u32 12 4294967055
// EXPECT u32 16 4
// EXPECT u32 20 7
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint a = 0xF0 + z;
  results.Store4(0, uint4(a & 0x3C, a | 0x0F, a ^ 0xFF, ~a));
  uint2 b = uint2(1, 2);
  b |= 4;
  b &= uint2(5, 6);
  b ^= 1;
  results.Store2(16, b);
}
