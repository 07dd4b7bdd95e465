// SPDX-License-Identifier: MIT
// FEATURE: core RWStructuredBuffer
// EXPECT u32 0 14
// EXPECT u32 4 10
// EXPECT u32 8 77
struct Item {
  uint a;
  uint2 b;
};
RWStructuredBuffer<Item> items : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  items[3].b.y = 77;
  items[3].a += 5;
  Item item = items[3];
  results.Store3(0, uint3(item.a, item.b));
}
