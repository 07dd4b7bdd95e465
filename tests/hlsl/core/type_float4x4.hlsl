// SPDX-License-Identifier: MIT
// FEATURE: core float4x4
// EXPECT f32 0 5.0
// EXPECT f32 4 13.0
// EXPECT f32 8 21.0
// EXPECT f32 12 29.0
// EXPECT f32 16 14.0
// EXPECT f32 20 16.0
// EXPECT f32 24 18.0
// EXPECT f32 28 20.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float4x4 m = float4x4(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
  results.Store4(0, asuint(mul(m, float4(1, 0, 0, 1) + z)));
  results.Store4(16, asuint(mul(float4(1, 0, 0, 1), m)));
}
