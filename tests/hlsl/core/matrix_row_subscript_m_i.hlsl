// SPDX-License-Identifier: MIT
// FEATURE: core matrix row subscript m[i]
// EXPECT f32 0 1.0
// EXPECT f32 4 20.0
// EXPECT f32 8 30.0
// EXPECT f32 12 4.0
// EXPECT f32 16 10.0
// EXPECT f32 20 12.0
// EXPECT f32 24 14.0
// EXPECT f32 28 16.0
// EXPECT f32 32 9.0
// EXPECT f32 36 10.0
// EXPECT f32 40 11.0
// EXPECT f32 44 50.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3x4 m = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  m[1] *= 2;
  m[z + 2][3] = 50;
  m[0].yz = float2(20, 30);
  results.Store4(0, asuint(m[z]));
  results.Store4(16, asuint(m[1]));
  results.Store4(32, asuint(m[2]));
}
