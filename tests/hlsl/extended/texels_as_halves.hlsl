// SPDX-License-Identifier: MIT
// FEATURE: extended texels of 32 bits as half
// OPTIONS: -enable-16bit-types -T lib_6_6
// They round toward zero, so that only infinity becomes infinite. [D3D11.3 3.2.2]
// EXPECT f32 0 65504 -65504 1 65504
// EXPECT f32 16 inf -inf 0.333251953125 -0.333251953125
// EXPECT u32 32 1 0 0x8001 0x8000
// EXPECT u32 48 1
// In the shader they round to nearest.
// EXPECT f32 52 inf 1.0009765625
RWByteAddressBuffer results : register(u0);
RWTexture2D<float4> image : register(u1);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const float z = results.Load(65532);  // 0, known at run time only
  const float infinity = asfloat(0x7F800000 + (uint)z);
  RWTexture2D<half4> same = ResourceDescriptorHeap[4];  // the descriptor of `image`
  image[uint2(1, 1)] = float4(65536, -1e30, 1.0009, 65519.9) + z;
  results.Store4(0, asuint((float4)same[uint2(1, 1)]));
  image[uint2(2, 1)] = float4(infinity, -infinity, 1.0 / (3 + z), -1.0 / (3 + z));
  results.Store4(16, asuint((float4)same[uint2(2, 1)]));
  // Just below 2 and 1 steps of a half's denormals.
  image[uint2(3, 1)] = float4(1.19e-7, 5.9e-8, -1.19e-7, -5.9e-8) + z;
  results.Store4(32, asuint16(same[uint2(3, 1)]));
  image[uint2(3, 1)].x = asfloat(0x7FC00000 + (uint)z);
  results.Store(48, isnan(same[uint2(3, 1)].x));
  results.Store2(52, asuint(float2((half)(65536 + z), (half)(1.0009 + z))));
}
