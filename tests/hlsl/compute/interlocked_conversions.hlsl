// SPDX-License-Identifier: MIT
// FEATURE: compute conversions of the values of Interlocked functions
// A value becomes a uint, so that what is below 0 is 0, also for memory of ints.
// EXPECT i32 0 5 5 13 7
// EXPECT u32 16 4000000100 3000000000 0
// Of Min and Max it becomes an int, and the memory's sign decides: -1 is the largest uint.
// EXPECT u32 28 0xFFFFFFFF 7 0x7FFFFFFF
// EXPECT i32 40 -2 3
// Comparisons: 0 with -0.5.
// EXPECT i32 48 9 8
// The original value is a uint or an int like its variable, and an int for any other.
// EXPECT f32 56 -1 -1
// EXPECT u32 64 0xFFFFFFFF 0xFFFFFFFF
RWByteAddressBuffer results : register(u0);
groupshared int i;
groupshared uint u;

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const float z = results.Load(65532);  // 0, known at run time only
  i = 5;
  InterlockedAdd(i, z - 3.0);
  results.Store(0, i);
  InterlockedAdd(i, -3.5);
  results.Store(4, i);
  InterlockedOr(i, z + 8.9);
  results.Store(8, i);
  InterlockedAnd(i, z + 7.5);
  InterlockedXor(i, z + 2.5);  // 5 ^ 2
  results.Store(12, i);
  u = 100;
  InterlockedAdd(u, z + 4e9);
  results.Store(16, u);
  uint original;
  InterlockedExchange(i, z + 3e9, original);
  results.Store(20, i);
  InterlockedExchange(i, z - 3, original);
  results.Store(24, i);

  u = 7;
  InterlockedMax(u, z - 1.0);
  results.Store(28, u);
  u = 7;
  InterlockedMin(u, z - 1.0);
  results.Store(32, u);
  InterlockedMax(u, z + 3e9);  // the largest int
  results.Store(36, u);
  i = 3;
  InterlockedMin(i, z - 2.9);
  results.Store(40, i);
  i = 3;
  InterlockedMax(i, z - 2.9);
  results.Store(44, i);

  i = 0;
  InterlockedCompareStore(i, z - 0.5, 9);
  results.Store(48, i);
  InterlockedCompareExchange(i, z + 9.9, z + 8.2, original);
  results.Store(52, i);

  float as_float;
  int as_int;
  i = -1;
  u = 0xFFFFFFFF;
  InterlockedAdd(i, 0, as_float);
  results.Store(56, asuint(as_float));
  InterlockedAdd(u, 0, as_float);
  results.Store(60, asuint(as_float));
  InterlockedAdd(u, 0, as_int);
  results.Store(64, as_int);
  InterlockedAdd(i, 0, original);
  results.Store(68, original);
}
