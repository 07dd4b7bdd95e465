// SPDX-License-Identifier: MIT
// FEATURE: core #pragma pack_matrix
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 4
// EXPECT u32 12 5
// EXPECT u32 16 0
// EXPECT u32 20 4
// EXPECT u32 24 1
// EXPECT u32 28 5
#pragma pack_matrix(row_major)
cbuffer Constants : register(b0) {
  uint2x2 a;
};
#pragma pack_matrix(column_major)
cbuffer More : register(b1) {
  uint2x2 b;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(a[0], a[1]));
  results.Store4(16, uint4(b[0], b[1]));
}
