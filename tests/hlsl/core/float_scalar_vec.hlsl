// SPDX-License-Identifier: MIT
// FEATURE: core float scalar/vec
// EXPECT f32 0 2.25
// EXPECT f32 4 3.0
// EXPECT f32 8 4.5
// EXPECT f32 12 6.0
// EXPECT f32 16 31.25
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float a = 1.5 + z;
  float2 b = float2(a, 2);
  float3 c = float3(b, 3);
  float4 d = float4(c, 4);
  results.Store4(0, asuint(d * a));
  results.Store(16, asuint(dot(d, d)));
}
