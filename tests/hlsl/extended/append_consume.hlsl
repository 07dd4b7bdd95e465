// SPDX-License-Identifier: MIT
// FEATURE: extended IncrementCounter, DecrementCounter, Append, Consume
// EXPECT u32 0 0 1 7 6
// EXPECT u32 16 7 6 12 13
// EXPECT u32 32 1 4 128 8
// out of bounds: an element past the end is dropped or zero, but counts
// EXPECT u32 48 0 4294967295
RWByteAddressBuffer results : register(u0);
struct Pair { uint a; uint b; };
RWStructuredBuffer<uint> counted_up : register(u1);
RWStructuredBuffer<uint> counted_down_from_8 : register(u2);
ConsumeStructuredBuffer<uint> counted_consumed_from_8 : register(u3);
ConsumeStructuredBuffer<Pair> counted_pairs_from_8 : register(u4);
AppendStructuredBuffer<Pair> counted_appended : register(u5);
ConsumeStructuredBuffer<uint> counted_empty : register(u6);
RWStructuredBuffer<uint> counted_empty_too : register(u7);

void add(AppendStructuredBuffer<Pair> target, uint a) {
  Pair pair = {a, a + 1};
  target.Append(pair);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  // Word i of each buffer is i.
  results.Store(0, counted_up.IncrementCounter());
  results.Store(4, counted_up.IncrementCounter() + z);
  results.Store(8, counted_down_from_8.DecrementCounter());
  results.Store(12, counted_down_from_8.DecrementCounter());
  const uint first = counted_consumed_from_8.Consume();
  results.Store2(16, uint2(first, counted_consumed_from_8.Consume()));
  counted_pairs_from_8.Consume();
  const Pair pair = counted_pairs_from_8.Consume();
  results.Store2(24, uint2(pair.a, pair.b));
  counted_up[counted_up.IncrementCounter()] = 1;
  results.Store(32, counted_up[2]);
  add(counted_appended, 5);
  add(counted_appended, z);
  uint count, stride;
  counted_consumed_from_8.GetDimensions(count, stride);
  results.Store(36, stride);
  counted_appended.GetDimensions(count, stride);
  results.Store2(40, uint2(count, stride));
  results.Store(48, counted_empty.Consume());
  results.Store(52, counted_empty_too.DecrementCounter());
}
