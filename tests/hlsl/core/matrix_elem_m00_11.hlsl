// SPDX-License-Identifier: MIT
// FEATURE: core matrix elem ._m00/._11
// EXPECT f32 0 1.0
// EXPECT f32 4 2.0
// EXPECT f32 8 7.0
// EXPECT f32 12 40.0
// EXPECT f32 16 10.0
// EXPECT f32 20 50.0
// EXPECT f32 24 90.0
// EXPECT f32 28 90.0
// EXPECT f32 32 10.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3x3 m = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  m._m01 += z;
  m._21 = 40;
  results.Store4(0, asuint(float4(m._m00, m._12, m._m20, m._21)));
  m._m00_m11_m22 = float3(10, 50, 90);
  results.Store3(16, asuint(m._11_22_33));
  results.Store2(28, asuint(m._m00_m22.yx));
}
