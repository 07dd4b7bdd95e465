// SPDX-License-Identifier: MIT
// FEATURE: core implicit trunc: float3 = tex/mul(float4) w/o swizzle
// EXPECT f32 0 2.0
// EXPECT f32 4 3.0
// EXPECT f32 8 0.0
// EXPECT f32 12 10.0
// EXPECT f32 16 10.0
// EXPECT f32 20 10.0
Texture2D<float4> image : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float3 a = image[uint2(2, 3)];
  results.Store3(0, asuint(a));
  float3 b = mul((float4x4)1 + z, float4(1, 2, 3, 4));
  results.Store3(12, asuint(b));
}
