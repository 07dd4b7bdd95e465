// SPDX-License-Identifier: MIT
// FEATURE: extended RWByteAddressBuffer
// EXPECT u32 0 5
// EXPECT u32 4 6
// EXPECT u32 8 7
// EXPECT u32 12 5
RWByteAddressBuffer more : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  more.Store(8, 5u);
  more.Store2(12, uint2(6, 7));
  results.Store4(0, more.Load4(8));
}
