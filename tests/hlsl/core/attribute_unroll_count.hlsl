// SPDX-License-Identifier: MIT
// FEATURE: core attribute [unroll(N)] on loops of more turns
// The loop ends after N turns, whatever its condition says.
// EXPECT u32 0 4 6 10
// EXPECT u32 12 3 5
// EXPECT u32 20 2 2
// EXPECT u32 28 3
// EXPECT u32 32 12 3
// EXPECT u32 40 8 2 5
RWByteAddressBuffer results : register(u0);
static const uint kTwo = 2;

uint next(inout uint x) { return x++; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint i, sum = z;
  [unroll(4)]
  for (i = 0; i < 8; ++i) sum += i;
  results.Store2(0, uint2(i, sum));
  // A turn that continues counts.
  sum = z;
  [unroll(5)]
  for (i = 0; i < 8 + z; ++i) {
    if (i == 0) continue;
    sum += i;
  }
  results.Store(8, sum);
  // The condition is evaluated after each turn, and before the first.
  uint turns = 0, x = z;
  [unroll(3)]
  while (next(x) < 100) ++turns;
  results.Store2(12, uint2(turns, x + 1));
  turns = 0;
  x = z;
  [unroll(kTwo)]
  do {
    ++turns;
  } while (next(x) < 100);
  results.Store2(20, uint2(turns, x));
  // Without an end of its own.
  turns = 0;
  [unroll(3)]
  while (true) ++turns;
  results.Store(28, turns);
  // Each loop of a nest has its own count, which begins anew.
  turns = 0;
  uint outer = 0;
  [unroll(3)]
  for (i = 0; i < 8 + z; ++i) {
    ++outer;
    [unroll(4)]
    for (uint j = 0; j < 8 + z; ++j) ++turns;
  }
  results.Store2(32, uint2(turns, outer));
  // More than there are, 0 for all, and a loop that breaks first.
  sum = 0;
  [unroll(20)]
  for (i = 0; i < 3 + z; ++i) ++sum;
  [unroll(0)]
  for (i = 0; i < 5; ++i) ++sum;
  turns = 0;
  [unroll(4)]
  for (i = 0; i < 8; ++i) {
    if (i == 2 + z) break;
    ++turns;
  }
  results.Store3(40, uint3(sum, turns, 5));
}
