// SPDX-License-Identifier: MIT
// FEATURE: core ternary ?:
// EXPECT u32 0 3
// EXPECT f32 4 4.0
// EXPECT f32 8 5.0
// EXPECT f32 12 6.0
// EXPECT f32 16 2.5
// EXPECT f32 20 7.0
// EXPECT f32 24 8.0
// EXPECT f32 28 9.0
// EXPECT f32 32 1.0
// EXPECT f32 36 2.0
// EXPECT f32 40 3.0
// EXPECT f32 44 8.0
// EXPECT f32 48 7.0
RWByteAddressBuffer results : register(u0);

struct Inner {
  float3 v;
};
struct Outer {
  Inner inner;
};

// Every operand except the condition is an lvalue inside a structure, and one of them is assigned to.
float3 of_places(bool first, Outer a, Inner b) {
  b.v = first ? a.inner.v : b.v;
  return b.v;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint a = z == 0 ? 3 : 4;
  float3 b = a > 3 ? float3(1, 2, 3) : float3(4, 5, 6);
  results.Store(0, a);
  results.Store3(4, asuint(b));
  results.Store(16, asuint(z ? 1 : 2.5));
  Outer outer;
  outer.inner.v = float3(7, 8, 9) + z;
  Inner inner;
  inner.v = float3(1, 2, 3) + z;
  results.Store3(20, asuint(of_places(z == 0, outer, inner)));
  results.Store3(32, asuint(of_places(z != 0, outer, inner)));
  float2 swapped = outer.inner.v.xy;
  const float2 turned = swapped.yx;
  swapped = z == 0 ? turned : swapped;
  results.Store2(44, asuint(swapped));
}
