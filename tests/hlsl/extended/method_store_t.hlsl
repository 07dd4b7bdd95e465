// SPDX-License-Identifier: MIT
// FEATURE: extended .Store<T> (templated)
// EXPECT u32 8 3
// EXPECT f32 12 4.5
// EXPECT f32 16 1.0
// EXPECT f32 20 2.0
// EXPECT u32 24 3
struct Item {
  uint a;
  float b;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  Item item = {3, 4.5};
  results.Store<Item>(8, item);
  results.Store<float2>(16, float2(1, 2));
  results.Store(24, item);
}
