// SPDX-License-Identifier: MIT
// TRAP: 2 storage order
// EXPECT u32 0 1
// EXPECT u32 4 5
// EXPECT u32 8 9
// EXPECT u32 12 16
// EXPECT u32 16 17
// EXPECT u32 20 18
// EXPECT u32 24 1
// EXPECT u32 28 3
// EXPECT u32 32 5
// EXPECT u32 36 10
cbuffer A : register(b0) {
  uint2x3 columns;
  row_major uint2x3 rows;
};
StructuredBuffer<uint2x3> tight : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store3(0, columns[1]);
  results.Store3(12, rows[1]);
  results.Store3(24, tight[0][1]);
  results.Store(36, tight[z + 1]._m02);
}
