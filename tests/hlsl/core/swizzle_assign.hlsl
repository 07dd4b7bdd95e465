// SPDX-License-Identifier: MIT
// FEATURE: core swizzle assign v.xy = / op=
// EXPECT f32 0 4.0
// EXPECT f32 4 5.0
// EXPECT f32 8 60.0
// EXPECT f32 12 40.0
// EXPECT f32 16 60.0
// EXPECT f32 20 5.0
// EXPECT f32 24 4.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float4 v = float4(1, 2, 3, 4) + z;
  v.xy = v.zw;
  v.wz *= float2(10, 20);
  v.rg += 1;
  results.Store4(0, asuint(v));
  v.zyx = v.xyz;
  results.Store3(16, asuint(v.xyz));
}
