// SPDX-License-Identifier: MIT
// FEATURE: core default args
// EXPECT u32 0 111
// EXPECT u32 4 103
// EXPECT u32 8 6
uint f(uint a, uint b = 10, uint c = 100) {
  return a + b + c;
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store3(0, uint3(f(1), f(1, 2), f(1, 2, 3)));
}
