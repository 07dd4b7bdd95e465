// SPDX-License-Identifier: MIT
// FEATURE: core (Struct)0 cast
// EXPECT u32 0 0
// EXPECT u32 4 0
// EXPECT u32 8 0
// EXPECT u32 12 0
// EXPECT u32 16 5
// EXPECT u32 20 0
struct Item {
  float3 a;
  uint b[2];
  bool c;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Item item = (Item)0;
  item.b[1] += 5 + z;
  results.Store3(0, asuint(item.a));
  results.Store3(12, uint3(item.b[0], item.b[1], item.c));
}
