// SPDX-License-Identifier: MIT
// FEATURE: extended class
// EXPECT u32 0 6
class Item {
  uint a;
  uint get() { return a; }
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Item item;
  item.a = z + 6;
  results.Store(0, item.get());
}
