// SPDX-License-Identifier: MIT
// FEATURE: compute conversions of the values of Interlocked methods
// A value becomes a uint; of Min and Max an int unless it is a uint, and its sign decides.
// EXPECT u32 0 5 4000000000
// EXPECT i32 8 -2 3 -1 3
// EXPECT u32 24 0xFFFFFFFF 0x7FFFFFFF
// The original value is a uint.
// EXPECT f32 32 4294967295.0 4294967295.0
// Structured and typed buffers are like groupshared memory.
// EXPECT u32 40 3 0xFFFFFFFF 4 0xFFFFFFFF
RWByteAddressBuffer results : register(u0);
RWStructuredBuffer<uint> structured : register(u1);
RWBuffer<int> typed : register(u2);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const float z = results.Load(65532);  // 0, known at run time only
  results.Store(0, 5);
  results.InterlockedAdd(0, z - 3.0);
  results.Store(4, 1);
  uint original;
  results.InterlockedExchange(4, z + 4e9, original);
  results.Store(8, 7);
  results.InterlockedMin(8, z - 2.5);
  results.Store(12, -4);
  results.InterlockedMax(12, 3);
  results.Store(16, 7);
  results.InterlockedMin(16, -1);
  results.Store(20, 3);
  results.InterlockedMax(20, (int)(z - 1));
  results.Store(24, 3);
  results.InterlockedMax(24, 0xFFFFFFFFu + (uint)z);
  results.Store(28, 3);
  results.InterlockedMax(28, z + 3e9);

  float as_float;
  results.Store(80, 0xFFFFFFFF);
  results.InterlockedAdd(80, 0, as_float);
  results.Store(32, asuint(as_float));
  results.InterlockedMax(80, 1, as_float);  // signed: leaves 1
  results.Store(36, asuint(as_float));

  InterlockedAdd(structured[3], z - 1.0);
  results.Store(40, structured[3]);
  InterlockedMax(structured[3], z - 1.0);
  results.Store(44, structured[3]);
  InterlockedAdd(typed[4], z - 1.0);
  results.Store(48, typed[4]);
  InterlockedMin(typed[4], z - 1.0);
  results.Store(52, typed[4]);
}
