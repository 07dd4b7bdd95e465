// SPDX-License-Identifier: MIT
// FEATURE: core float3x3
// EXPECT f32 0 6.0
// EXPECT f32 4 15.0
// EXPECT f32 8 25.0
// EXPECT f32 12 -3.0 4
// EXPECT f32 16 1.0
// EXPECT f32 20 4.0
// EXPECT f32 24 7.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3x3 m = float3x3(float3(1, 2, 3), float3(4, 5, 6), float3(7, 8, 10) + z);
  results.Store3(0, asuint(mul(m, float3(1, 1, 1))));
  results.Store(12, asuint(determinant(m)));
  results.Store3(16, asuint(transpose(m)[0]));
}
