// SPDX-License-Identifier: MIT
// FEATURE: compute Interlocked operations on 64 bits in buffers and groupshared memory
// Each pair is the value before an operation, and the last one of a row what is there in the end.
// add, min, max, exchange, compare-exchange that fails and that succeeds, of a structured buffer
// EXPECT u64 0 0x100000000 0x100000005 0xFFFFFFFFFFFFFFFE 0xFFFFFFFFFFFFFFFE 0x7000000001 0x7000000001 9
// the same bitwise: and, or, xor
// EXPECT u64 56 0xFF00FF00FF 0xF000F0000F 0xF000F0F0F0F 0xF
// groupshared memory, int64_t: add, min, max, compare-store; -5e9, -5e9 + 1, -6e9, 7e9, 3
// EXPECT u64 88 0xFFFFFFFED5FA0E00 0xFFFFFFFED5FA0E01 0xFFFFFFFE9A5F4400 0x1A13B8600 0x3
// RWByteAddressBuffer, the methods that end in 64
// EXPECT u64 128 0x200000001 0x200000002 0x200000002 0x1 0x5
RWByteAddressBuffer results : register(u0);
RWStructuredBuffer<uint64_t> numbers : register(u1);
RWByteAddressBuffer raw : register(u3);
groupshared int64_t shared_number;

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint64_t before;
  numbers[3] = 0x100000000ull + z;
  InterlockedAdd(numbers[3], 5ull, before);
  results.Store(0, before);
  InterlockedMax(numbers[3], 0xFFFFFFFFFFFFFFFEull, before);
  results.Store(8, before);
  InterlockedMin(numbers[3], 0xFFFFFFFFFFFFFFFFull, before);
  results.Store(16, before);
  InterlockedExchange(numbers[3], 0x7000000001ull, before);
  results.Store(24, before);
  InterlockedCompareExchange(numbers[3], 1ull, 8ull, before);  // only the low half agrees
  results.Store(32, before);
  InterlockedCompareExchange(numbers[3], 0x7000000001ull, 9ull, before);
  results.Store(40, before);
  results.Store(48, numbers[3]);

  numbers[4] = 0xFF00FF00FFull + z;
  InterlockedAnd(numbers[4], 0xF000F0000Full, before);
  results.Store(56, before);
  InterlockedOr(numbers[4], 0x0F0F0F00ull | 0xF0000000000ull, before);
  results.Store(64, before);
  numbers[4] = 0xF000F0F0F0Full;
  InterlockedXor(numbers[4], 0xF000F0F0F00ull, before);
  results.Store(72, before);
  results.Store(80, numbers[4]);

  int64_t old;
  shared_number = -5000000000ll + z;
  InterlockedAdd(shared_number, 1ll, old);
  results.Store(88, old);
  InterlockedMin(shared_number, -6000000000ll, old);
  results.Store(96, old);
  InterlockedMax(shared_number, 7000000000ll, old);
  results.Store(104, old);
  results.Store(112, shared_number);
  InterlockedCompareStore(shared_number, 7000000000ll, 3ll);
  InterlockedCompareStore(shared_number, 4ll, 5ll);
  results.Store(120, shared_number);

  raw.Store(16, 0x200000001ull + z);
  raw.InterlockedAdd64(16, 1ull, before);
  results.Store(128, before);
  raw.InterlockedMax64(16, 7ull, before);
  results.Store(136, before);
  raw.InterlockedExchange64(16, 1ull, before);
  results.Store(144, before);
  raw.InterlockedCompareExchange64(16, 1ull, 4ull, before);
  results.Store(152, before);
  raw.InterlockedOr64(16, 1ull);
  results.Store(160, raw.Load<uint64_t>(16));
}
