// SPDX-License-Identifier: MIT
// FEATURE: core StructuredBuffer
// EXPECT u32 0 8
// EXPECT u32 4 9
// EXPECT u32 8 10
// EXPECT u32 12 11
// EXPECT u32 16 15
// EXPECT u32 20 4
struct Item {
  uint a;
  uint3 b;
};
StructuredBuffer<Item> items : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Item item = items[2 + z];
  results.Store4(0, uint4(item.a, item.b));
  results.Store(16, items[3].b.z);
  results.Store(20, items.Load(1).a);
}
