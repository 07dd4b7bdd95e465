// SPDX-License-Identifier: MIT
// FEATURE: core this
// EXPECT u32 0 9
// EXPECT u32 4 6
// DXC fails on the method that returns `this` as a whole, though HLSL has it.
struct Item {
  uint a;
  void set(uint a) { this.a = a; }
  uint sum(Item other) { return this.a + other.a; }
  Item copy() { return this; }
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Item x, y;
  x.set(3 + z);
  y = x.copy();
  y.a *= 2;
  results.Store2(0, uint2(x.sum(y), y.a));
}
