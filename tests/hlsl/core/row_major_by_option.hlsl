// SPDX-License-Identifier: MIT
// FEATURE: core row_major by option
// OPTIONS: -Zpr
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 4
// EXPECT u32 12 5
// EXPECT u32 16 8
// EXPECT u32 20 12
// EXPECT u32 24 9
// EXPECT u32 28 13
cbuffer Constants : register(b0) {
  uint2x2 a;
  column_major uint2x2 b;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(a[0], a[1]));
  results.Store4(16, uint4(b[0], b[1]));
}
