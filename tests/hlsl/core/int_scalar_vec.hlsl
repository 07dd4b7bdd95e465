// SPDX-License-Identifier: MIT
// FEATURE: core int scalar/vec
// EXPECT i32 0 -14
// EXPECT i32 4 4
// EXPECT i32 8 -6
// EXPECT i32 12 -3
// EXPECT i32 16 -3
// EXPECT u32 20 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  int a = -7 + (int)z;
  int3 b = int3(a, 2, -3);
  results.Store3(0, asuint(b * 2));
  results.Store(12, asuint(a / 2));
  results.Store(16, asuint(a % 4));
  results.Store(20, a < 2 ? 1u : 0u);
}
