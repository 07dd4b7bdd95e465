// SPDX-License-Identifier: MIT
// TRAP: 21 bool is a word in memory
// EXPECT u32 0 1
// EXPECT u32 4 1
// EXPECT u32 8 1
// EXPECT u32 12 1
// EXPECT u32 16 0
// EXPECT u32 20 1
// EXPECT u32 24 16
struct S {
  bool a;
  bool3 b;
};
RWStructuredBuffer<S> items : register(u1);
StructuredBuffer<bool> flags : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  items[1].b.y = true;
  S s = items[1];
  results.Store4(0, uint4(s.a, s.b));
  results.Store2(16, uint2(flags[0], flags[7]));
  results.Store(24, sizeof(S));
}
