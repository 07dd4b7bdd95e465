// SPDX-License-Identifier: MIT
// TRAP: 1 matrices have rows
// EXPECT f32 0 4.0
// EXPECT f32 4 5.0
// EXPECT f32 8 6.0
// EXPECT f32 12 1.0
// EXPECT f32 16 4.0
// EXPECT f32 20 1.0
// EXPECT f32 24 2.0
// EXPECT f32 28 3.0
// EXPECT f32 32 14.0
// EXPECT f32 36 32.0
// EXPECT f32 40 32.0
// EXPECT f32 44 77.0
// EXPECT f32 48 60.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float2x3 m = float2x3(float3(1, 2, 3), float3(4, 5, 6) + z);
  results.Store3(0, asuint(m[1]));
  results.Store2(12, asuint(mul(m, float3(1, 0, 0))));
  results.Store3(20, asuint(mul(float2(1, 0), m)));
  float3x2 t = transpose(m);
  results.Store4(32, asuint((float4)mul(m, t)));
  m._m12 = 60;
  results.Store(48, asuint(m[1][2]));
}
