// SPDX-License-Identifier: MIT
// TRAP: 7 copy-in and copy-out
// EXPECT u32 0 2
// EXPECT u32 4 1
// EXPECT u32 8 1
// EXPECT u32 12 4
// EXPECT u32 16 3
// EXPECT u32 20 2
// EXPECT u32 24 1
// EXPECT u32 28 0
// EXPECT u32 32 12
// EXPECT u32 36 11
// EXPECT u32 40 21
// EXPECT u32 44 5
// EXPECT u32 48 0
// EXPECT u32 52 1
// EXPECT u32 56 7
// EXPECT u32 60 8
// EXPECT u32 64 1
// EXPECT u32 68 1
// EXPECT u32 72 3
// EXPECT u32 76 31
// EXPECT f32 80 1
// EXPECT f32 84 40
// EXPECT f32 88 3
// EXPECT f32 92 4
// EXPECT i32 96 -3
struct S {
  uint x;
  uint y;
};
void swap(inout uint2 a) { a = a.yx; }
void field_last(inout S whole, inout uint part) {
  whole.x += 10;
  whole.y += 10;
  part = 5;
}
void field_first(inout uint part, inout S whole) {
  part += 100;
  whole.x += 20;
}
void fill(out uint values[3], uint first) {
  for (uint i = 0; i < 3; ++i) values[i] = first + i;
}
void change(uint values[3], inout uint result) {
  values[0] = 31;
  result = values[0];
}
void scale(inout float x) { x *= 10; }
void negate(inout int x) { x = -x; }
uint next(inout uint x) { return x++; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint4 v = uint4(1, 2, 3, 4) + z;
  v.xyz = v.yxx;
  results.Store4(0, v);
  v = uint4(0, 1, 2, 3) + z;
  v.wzyx = v;
  results.Store4(16, v);
  S s = {1 + z, 2};
  field_last(s, s.x);  // the last parameter is copied back last, so its value stays in x
  results.Store2(32, uint2(s.y, 11));
  S t = {1 + z, 5};
  field_first(t.x, t);  // the struct is copied in before x changes and copied back after it
  results.Store4(40, uint4(t.x, t.y, 0, s.x == 5));
  uint a[3];
  fill(a, 7 + z);
  uint copy[3] = a;
  copy[2] = 1;
  results.Store3(56, uint3(a[0], a[1], copy[2]));
  uint b[3] = {1, 2, 3};
  uint result;
  change(b, result);  // arrays have value semantics
  results.Store3(68, uint3(b[0], b[2], result));
  float2x2 m = {1, 4, 3, 4};
  scale(m[0][z + 1]);
  results.Store4(80, asuint(float4(m[0], m._m10_m11)));
  float f = 3.75 + z;
  negate(f);  // copied in as 3
  results.Store(96, asuint((int)f));
}
