// SPDX-License-Identifier: MIT
// FEATURE: core C-style cast (floatN)x
// EXPECT i32 0 1
// EXPECT i32 4 -2
// EXPECT f32 8 1.75
// EXPECT f32 12 -2.5
// EXPECT f32 16 3.25
// EXPECT f32 20 7.0
// EXPECT f32 24 7.0
// EXPECT f32 28 11.0
// EXPECT u32 32 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float4 v = float4(1.75, -2.5, 3.25, 4) + z;
  results.Store2(0, asuint((int2)v));
  results.Store3(8, asuint((float3)v));
  results.Store2(20, asuint((float2)7));
  float3x3 m = (float3x3)float4x4(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
  results.Store(28, asuint(m[2][2]));
  results.Store(32, (uint)(float)3.9);
}
