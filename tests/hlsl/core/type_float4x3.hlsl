// SPDX-License-Identifier: MIT
// FEATURE: core float4x3
// EXPECT f32 0 4.0
// EXPECT f32 4 10.0
// EXPECT f32 8 16.0
// EXPECT f32 12 22.0
// EXPECT f32 16 10.0
// EXPECT f32 20 11.0
// EXPECT f32 24 12.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float4x3 m = float4x3(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12) + z;
  results.Store4(0, asuint(mul(m, float3(1, 0, 1))));
  results.Store3(16, asuint(mul(float4(0, 0, 0, 1), m)));
}
