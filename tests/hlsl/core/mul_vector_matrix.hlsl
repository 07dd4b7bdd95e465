// SPDX-License-Identifier: MIT
// FEATURE: core mul(vec,mat) style
// EXPECT f32 0 15.0
// EXPECT f32 4 18.0
// EXPECT f32 8 21.0
// EXPECT f32 12 22.0
// EXPECT f32 16 28.0
// EXPECT f32 20 49.0
// EXPECT f32 24 64.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3x3 m = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  results.Store3(0, asuint(mul(float3(1, 0, 2) + z, m)));
  float2x3 a = {1, 2, 3, 4, 5, 6};
  float3x2 b = {1, 2, 3, 4, 5, 6};
  results.Store4(12, asuint(float4(mul(a, b))));
}
