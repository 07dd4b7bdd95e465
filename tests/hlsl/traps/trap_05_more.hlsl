// SPDX-License-Identifier: MIT
// TRAP: 5 implicit conversions
// EXPECT u32 0 1
// EXPECT u32 4 0
// EXPECT u32 8 1
// EXPECT f32 12 2.5
// EXPECT f32 16 1
// EXPECT u32 20 4294967295
// EXPECT u32 24 1
// EXPECT f32 28 1
// EXPECT f32 32 2
// EXPECT f32 36 5
// EXPECT f32 40 6
// EXPECT u32 44 20
// EXPECT u32 48 10
// EXPECT u32 52 30
// EXPECT f32 56 3
// EXPECT f32 60 3
// EXPECT f32 64 3
// EXPECT u32 68 7
// EXPECT u32 72 0
// EXPECT u32 76 4294967295
// EXPECT u32 80 1
uint f(int x) { return 10; }
uint f(float x) { return 20; }
uint f(uint2 x) { return 30; }
uint half_of(float x) { return x; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  bool a = 0.25 + z;
  bool b = asfloat(0x80000000 + z);  // -0 is false
  bool c = asfloat(0x7fc00000 + z);  // NaN is true
  results.Store3(0, uint3(a, b, c));
  results.Store2(12, asuint(float2(z == 1 ? 1 : 2.5, z == 0 ? true : 2.5)));
  int minus = -1 + (int)z;
  results.Store2(20, uint2(minus * 1u, minus > 0u));
  float4x4 m = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  float2x2 upper = (float2x2)m;
  results.Store4(28, asuint(float4(upper[0], upper[1])));
  results.Store3(44, uint3(f(0.5 + z), f(2 + (int)z), f(uint2(z, z))));
  float3 splat = 3 + z;
  results.Store3(56, asuint(splat));
  results.Store(68, half_of(7.9 + z));
  results.Store(72, half_of(-7.9 + z));  // converting to uint saturates
  results.Store(76, half_of(1e30 + z));
  uint2 cut = uint3(1, 2, 3) + z;
  float1 one = cut;
  results.Store(80, (uint)one);
}
