// SPDX-License-Identifier: MIT
// FEATURE: extended .Store4
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 2
// EXPECT u32 12 3
// EXPECT u32 16 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(4, uint4(1, 2, 3, 4));
}
