// SPDX-License-Identifier: MIT
// FEATURE: extended .Store
// EXPECT u32 0 3
// EXPECT f32 4 1.5
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, 3);
  results.Store(4, asuint(1.5f));
}
