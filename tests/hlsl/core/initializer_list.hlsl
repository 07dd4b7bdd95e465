// SPDX-License-Identifier: MIT
// FEATURE: core initializer list = {..}
// EXPECT f32 0 1.0
// EXPECT f32 4 2.0
// EXPECT f32 8 3.0
// EXPECT u32 12 4
// EXPECT u32 16 5
// EXPECT f32 20 7.0
// EXPECT u32 24 9
// EXPECT f32 28 3.0
struct Item {
  float3 a;
  uint2 b;
  float c[2];
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Item item = {float2(1, 2), 3 + z, {4, 5}, 6, 7};
  results.Store3(0, asuint(item.a));
  results.Store2(12, item.b);
  results.Store(20, asuint(item.c[1]));
  Item list[2] = {item, {0, 0, 0, 8, 9, 10, 11}};
  results.Store(24, list[1].b.y);
  float2x2 m = {1, 2, float2(3, 4)};
  results.Store(28, asuint(m._m10));
}
