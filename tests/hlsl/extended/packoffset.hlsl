// SPDX-License-Identifier: MIT
// FEATURE: extended packoffset
// EXPECT u32 0 4
// EXPECT u32 4 2
// EXPECT u32 8 3
// EXPECT u32 12 11
cbuffer Constants : register(b0) {
  uint a : packoffset(c1);
  uint2 b : packoffset(c0.z);
  uint c : packoffset(c2.w);
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(a, b, c));
}
