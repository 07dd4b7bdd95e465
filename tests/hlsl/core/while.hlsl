// SPDX-License-Identifier: MIT
// FEATURE: core while
// EXPECT u32 0 111
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint x = 27 + z, steps = 0;
  while (x != 1) {
    x = x % 2 == 0 ? x / 2 : 3 * x + 1;
    ++steps;
    if (steps > 1000) break;
  }
  results.Store(0, steps);
}
