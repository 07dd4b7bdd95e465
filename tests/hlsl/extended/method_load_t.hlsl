// SPDX-License-Identifier: MIT
// FEATURE: extended .Load<T> (templated ByteAddressBuffer)
// EXPECT u32 0 4
// EXPECT u32 4 5
// EXPECT u32 8 6
// EXPECT u32 12 7
// EXPECT u32 16 3
struct Item {
  uint a;
  uint3 b;
};
ByteAddressBuffer bytes : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  Item item = bytes.Load<Item>(16);
  results.Store4(0, uint4(item.a, item.b));
  results.Store(16, bytes.Load<uint2>(8).y);
}
