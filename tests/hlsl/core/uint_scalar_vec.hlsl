// SPDX-License-Identifier: MIT
// FEATURE: core uint scalar/vec
// EXPECT u32 0 1
// EXPECT u32 4 4
// EXPECT u32 8 5
// EXPECT u32 12 6
// EXPECT u32 16 1431655764
// EXPECT u32 20 2
// EXPECT u32 24 5
// EXPECT u32 28 6
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint a = 0xfffffffe + z;
  uint4 b = uint4(a, 1, 2, 3);
  results.Store4(0, b + 3);
  results.Store(16, a / 3);
  results.Store(20, a % 7);
  dword c = 5;
  unsigned int d = 6;
  results.Store2(24, uint2(c, d));
}
