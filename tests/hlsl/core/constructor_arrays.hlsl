// SPDX-License-Identifier: MIT
// FEATURE: core constructors from arrays
// EXPECT f32 0 1
// EXPECT f32 4 2
// EXPECT f32 8 3
// EXPECT f32 12 4
// EXPECT f32 16 5
// EXPECT f32 20 1
// EXPECT f32 24 2
// EXPECT f32 28 7
// EXPECT i32 32 -2
// EXPECT i32 36 3
// EXPECT f32 40 4
// EXPECT f32 44 3
// EXPECT f32 48 8
// EXPECT f32 52 9
struct Pair {
  float a;
  int b;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float four[4] = {1, 2, 3, 4};
  four[0] += z;
  const float half_way[2] = {-2.75 + z, 3.5};
  results.Store4(0, asuint(float4(four)));
  // Elements in their order, among other arguments.
  const float pair[2] = {1 + z, 2};
  results.Store4(16, asuint(float4(5 + z, pair, 7)));
  results.Store2(32, asuint(int2(half_way)));
  const float2x2 m = float2x2(four);
  results.Store2(40, asuint(float2(m[1][1], m[1][0])));
  Pair p;
  p.a = 8 + z;
  p.b = 9;
  results.Store2(48, asuint(float2(p)));
}
