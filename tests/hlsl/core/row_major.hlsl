// SPDX-License-Identifier: MIT
// FEATURE: core row_major
// EXPECT f32 0 4.0
// EXPECT f32 4 3.0
// EXPECT f32 8 1.0
// EXPECT f32 12 20.0
// EXPECT f32 16 3.0
// EXPECT f32 20 4.0
// EXPECT f32 24 5.0
// EXPECT f32 28 30.0
struct Item {
  row_major float2x3 m;
  float2x3 n;
};
RWStructuredBuffer<Item> items : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Item item;
  item.m = float2x3(1, 2, 3, 4, 5, 6) + z;
  item.n = item.m;
  items[0] = item;
  ByteAddressBuffer unused;
  results.Store(0, asuint(items[0].m[1][0]));
  results.Store(4, asuint(items[0].n._m02));
  items[0].m._m01 = 20;
  items[0].n[1].z = 30;
  results.Store3(8, asuint(items[0].m[0]));
  results.Store3(20, asuint(items[0].n[1]));
}
