// SPDX-License-Identifier: MIT
// TRAP: 13 automatic registers
// EXPECT u32 0 1
// EXPECT u32 4 2
// EXPECT u32 8 3
// EXPECT u32 12 4
// EXPECT u32 16 5
StructuredBuffer<uint> a;
StructuredBuffer<uint> b : register(t0);
ByteAddressBuffer many[] : register(t0, space1);
ByteAddressBuffer aliased[] : register(t0, space2);
StructuredBuffer<uint> c;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, uint4(a[1], b[2], c[3], many[z].Load(16)));
  results.Store(16, aliased[1].Load(20));
}
