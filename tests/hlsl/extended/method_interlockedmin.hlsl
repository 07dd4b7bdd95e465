// SPDX-License-Identifier: MIT
// FEATURE: extended .InterlockedMin
// EXPECT u32 0 3
// EXPECT u32 4 10
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  uint before;
  results.Store(0, 10);
  results.InterlockedMin(0, 3u, before);
  results.Store(4, before);
  results.InterlockedMin(8, 0u);
}
