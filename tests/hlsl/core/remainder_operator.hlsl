// SPDX-License-Identifier: MIT
// FEATURE: core % operator
// EXPECT i32 0 -1
// EXPECT u32 4 3
// EXPECT f32 8 -1.5
// EXPECT u32 12 1
// EXPECT u32 16 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  int a = -7 + (int)z;
  results.Store(0, asuint(a % 3));
  results.Store(4, 7u % 4u);
  results.Store(8, asuint((-7.5 + z) % 2.0));
  uint2 b = uint2(9, 10) + z;
  b %= 4;
  results.Store2(12, b);
}
