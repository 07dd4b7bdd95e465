// SPDX-License-Identifier: MIT
// TRAP: 4 structured buffers are tight, raw loads ignore low bits
// EXPECT u32 0 7
// EXPECT u32 4 10
// EXPECT u32 8 13
// EXPECT u32 12 3
// EXPECT u32 16 5
struct S {
  uint3 a;
  uint b;
  uint3 c;
};
StructuredBuffer<S> items : register(t0);
ByteAddressBuffer bytes : register(t1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, uint4(items[1].a.x, items[1].b, items[z + 1].c.z, bytes.Load(12)));
  StructuredBuffer<uint> none;
  results.Store(16, 5);
}
