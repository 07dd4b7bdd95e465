// SPDX-License-Identifier: MIT
// FEATURE: core function overloads
// EXPECT u32 0 1
// EXPECT u32 4 2
// EXPECT u32 8 3
// EXPECT u32 12 4
// EXPECT u32 16 5
// EXPECT u32 20 4
uint f(float x) { return 1; }
uint f(int x) { return 2; }
uint f(uint x) { return 3; }
uint f(float3 x) { return 4; }
uint f(float x, float y) { return 5; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, uint4(f(1.0), f(int(1)), f(1u), f(float3(1, 2, 3))));
  results.Store2(16, uint2(f(1, 2), f(int3(1, 2, 3) + z)));
}
