// SPDX-License-Identifier: MIT
// FEATURE: core attribute [unroll]
// EXPECT u32 0 9
// EXPECT u32 4 9
// EXPECT u32 8 6
// EXPECT u32 12 56
// EXPECT u32 16 3
// DXC refuses the loop whose count it cannot deduce, which is a limit of its own.
RWByteAddressBuffer results : register(u0);

uint next(inout uint x) { return x++; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint sum = z;
  [unroll]
  for (uint i = 0; i < 4; ++i) sum += i;
  [unroll(3)]
  for (uint j = 0; j < 3; ++j) sum += j;
  results.Store(0, sum);

  uint odd = 0;
  [unroll]
  for (uint k = 0; k < 8; ++k) {
    if ((k & 1) == 0) continue;
    if (k == 7 + z) break;
    odd += k;
  }
  // The attribute says how many iterations there are at most; their number is only known at run time.
  uint many = 0;
  [unroll(4)]
  for (uint n = 0; n < 41 + z; ++n) many += n;
  // A condition with a side effect, and a condition at the end of the loop.
  uint calls = 0, x = z;
  [unroll]
  while (next(x) < 5) ++calls;
  uint once = 0;
  [unroll]
  do {
    ++once;
  } while (once < 3 + z);
  results.Store4(4, uint4(odd, many, calls * 10 + x, once));
}
