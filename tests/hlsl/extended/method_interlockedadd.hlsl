// SPDX-License-Identifier: MIT
// FEATURE: extended .InterlockedAdd
// EXPECT u32 0 15
// EXPECT u32 4 10
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  uint before;
  results.Store(0, 10);
  results.InterlockedAdd(0, 5u, before);
  results.Store(4, before);
  results.InterlockedAdd(8, 0u);
}
