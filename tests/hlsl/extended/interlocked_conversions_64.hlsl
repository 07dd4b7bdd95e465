// SPDX-License-Identifier: MIT
// FEATURE: extended conversions of the values of 64-bit Interlocked functions
// OPTIONS: -T lib_6_6
// EXPECT u32 0 5 0
// EXPECT u32 8 0xFFFFFFFF 0xFFFFFFFF
// EXPECT i32 16 -3 -1
// EXPECT i32 24 -2 -1
// EXPECT u32 32 6 0
RWByteAddressBuffer results : register(u0);
groupshared int64_t i;
groupshared uint64_t u;

void store(uint at, uint64_t x) { results.Store2(at, uint2((uint)x, (uint)(x >> 32))); }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const float z = results.Load(65532);  // 0, known at run time only
  i = 5;
  InterlockedAdd(i, z - 3.0);
  store(0, i);
  u = 5;
  InterlockedMax(u, z - 1.0);
  store(8, u);
  int64_t original;
  InterlockedExchange(i, z - 3.0, original);
  store(16, i);
  store(24, 6);
  results.InterlockedMin64(24, z - 2.0);
  store(32, 6);
  results.InterlockedAdd64(32, z - 2.0);
}
