// SPDX-License-Identifier: MIT
// FEATURE: core float3x4
// EXPECT f32 0 6.0
// EXPECT f32 4 8.0
// EXPECT f32 8 10.0
// EXPECT f32 12 1.0
// EXPECT f32 16 2.0
// EXPECT f32 20 3.0
// EXPECT f32 24 38.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3x4 m = float3x4(1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7) + z;
  results.Store3(0, asuint(mul(m, float4(1, 2, 3, 1))));
  results.Store4(12, asuint(mul(float3(1, 2, 3), m)));
}
