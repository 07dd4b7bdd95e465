// SPDX-License-Identifier: MIT
// FEATURE: compute InterlockedMin and Max of int
// EXPECT i32 0 3
// EXPECT i32 4 -9
groupshared int value;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  value = -5;
  InterlockedMax(value, 3);
  results.Store(0, asuint(value));
  InterlockedMin(value, -9);
  results.Store(4, asuint(value));
}
