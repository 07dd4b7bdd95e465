// SPDX-License-Identifier: MIT
// TRAP: 9 NaN in min, max, saturate
// EXPECT f32 0 nan
// EXPECT f32 4 nan
// EXPECT f32 8 1
// EXPECT f32 12 1
// EXPECT f32 16 1
// EXPECT f32 20 0
// EXPECT f32 24 inf
// EXPECT f32 28 -inf
// EXPECT u32 32 0
// EXPECT u32 36 0
// EXPECT u32 40 0
// EXPECT u32 44 1
// EXPECT u32 48 1
// EXPECT u32 52 1
// EXPECT i32 56 0
// EXPECT i32 60 0
// EXPECT f32 64 7
// EXPECT f32 68 8
// EXPECT u32 72 1
// EXPECT u32 76 0
// EXPECT u32 80 1
// EXPECT f32 84 0
// EXPECT f32 88 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const float nan = asfloat(0x7fc00000 + z);
  const float inf = asfloat(0x7f800000 + z);
  results.Store4(0, asuint(float4(min(nan, nan), max(nan, nan), min(float2(nan, 1), float2(1, nan)))));
  results.Store4(16, asuint(float4(saturate(inf), saturate(-inf), max(inf, nan), min(nan, -inf))));
  results.Store3(32, uint3(nan < 1, nan >= 1, nan == nan));
  results.Store3(44, uint3(!(nan < 1), nan != 1, any(float2(0, nan))));
  results.Store2(56, asuint(int2(sign(nan), (int)nan)));
  results.Store2(64, asuint(float2(nan ? 7 : 9, nan > 0 ? 7 : 8)));
  results.Store3(72, (uint3)isnan(float3(nan, inf, inf - inf)));
  results.Store2(84, asuint(saturate(float2(nan, 2))));
}
