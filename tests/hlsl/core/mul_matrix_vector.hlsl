// SPDX-License-Identifier: MIT
// FEATURE: core mul(mat,vec) style
// EXPECT f32 0 7.0
// EXPECT f32 4 16.0
// EXPECT f32 8 25.0
// EXPECT f32 12 11.0
// EXPECT f32 16 6.0
// EXPECT f32 20 8.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3x3 m = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  results.Store3(0, asuint(mul(m, float3(1, 0, 2) + z)));
  results.Store(12, asuint(mul(float2(1, 2), float2(3, 4))));
  results.Store2(16, asuint(mul(2, float2(3, 4))));
}
