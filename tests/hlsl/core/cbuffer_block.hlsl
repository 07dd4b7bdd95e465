// SPDX-License-Identifier: MIT
// FEATURE: core cbuffer block
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 2
// EXPECT u32 12 3
// EXPECT u32 16 4
// EXPECT u32 20 8
// EXPECT u32 24 9
cbuffer Constants : register(b0) {
  uint a;
  uint3 b;
  uint c[2];
  uint d;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(a, b));
  results.Store3(16, uint3(c[0], c[1], d));
}
