// SPDX-License-Identifier: MIT
// TRAP: 3 constant buffer packing
// EXPECT u32 0 3
// EXPECT u32 4 5
// EXPECT u32 8 8
// EXPECT u32 12 16
// EXPECT u32 16 17
// EXPECT u32 20 20
// EXPECT u32 24 22
// EXPECT u32 28 23
// EXPECT u32 32 12
struct S {
  uint x;
  uint2 y;
};
cbuffer C : register(b0) {
  uint3 a;
  uint b;
  uint2 c;
  uint3 d;
  uint e[2];
  uint f;
  S s;
  uint g;
  double h;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(b, c.y, d.x, e[1]));
  results.Store4(16, uint4(f, s.x, s.y.y, g));
  results.Store(32, sizeof(S));
}
