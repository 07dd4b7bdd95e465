// SPDX-License-Identifier: MIT
// TRAP: 7 copy-in and copy-out
// EXPECT f32 0 5
// EXPECT f32 4 0
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT u32 16 4
// EXPECT u32 20 0
// EXPECT u32 24 9
// EXPECT u32 28 2
// EXPECT u32 32 19
// EXPECT f32 36 1
// EXPECT f32 40 3
// EXPECT f32 44 3
// EXPECT f32 48 8
// EXPECT u32 52 4
// EXPECT u32 56 1
// EXPECT u32 60 0
// EXPECT u32 64 0
// EXPECT u32 68 3
// EXPECT u32 72 2
// EXPECT u32 76 12
// Order of evaluation: operands from left to right, the assigned value before the place it goes to.
struct S {
  float3 a;
  uint b[2];
};
uint f(uint x = 3) { return x; }
float4 raise(inout float4 v) {
  v.x += 1;
  return v;
}
uint pair(uint a, uint b) { return 10 * a + b; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float4 v = z;
  const float4 w = raise(v) + raise(v) * v.x;
  results.Store4(0, asuint(w));
  S s[2] = {{1, 2, 3, 4, 5}, {6, 7, 8, 9, 10}};
  uint i = z;
  s[i++].b[i++] = i;
  results.Store4(16, uint4(s[0].b[0], s[0].b[1], s[1].b[0], i));
  int a = 5 + (int)z;
  a += a++ + ++a;
  results.Store(32, a);
  float3x3 m = (float3x3)(1.0 + z);
  m[1].yz = m[0].xy * 3;
  m._m20_m02 = float2(7, 8);
  results.Store3(36, asuint(m[1]));
  results.Store(48, asuint(m[0][2]));
  uint2 q = uint2(1, 2) + z;
  q.xy = q.yx;
  q.x <<= q.y;
  results.Store2(52, q);
  for (uint k = 0, n = 3; k < n; k++) {
    if (k == 1) continue;
    results.Store(60 + 4 * k, k ? f() : f(k));
  }
  uint j = z;
  results.Store(72, j++ + 2 * j);
  j = 1 + z;
  results.Store(76, pair(j++, j));
}
