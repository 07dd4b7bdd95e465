// SPDX-License-Identifier: MIT
// FEATURE: core RWTexture2D
// EXPECT f32 0 2.0
// EXPECT f32 4 14.0
// EXPECT f32 8 6.0
// EXPECT f32 12 8.0
RWTexture2D<float4> image : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  image[uint2(3, 2)] = float4(1, 2, 3, 4) * 2;
  image[uint2(3, 2)].y += 10;
  results.Store4(0, asuint(image[uint2(3, 2)]));
}
