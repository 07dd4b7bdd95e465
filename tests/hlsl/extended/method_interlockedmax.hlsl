// SPDX-License-Identifier: MIT
// FEATURE: extended .InterlockedMax
// EXPECT u32 0 20
// EXPECT u32 4 10
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  uint before;
  results.Store(0, 10);
  results.InterlockedMax(0, 20u, before);
  results.Store(4, before);
  results.InterlockedMax(8, 0u);
}
