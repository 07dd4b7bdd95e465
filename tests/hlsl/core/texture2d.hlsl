// SPDX-License-Identifier: MIT
// FEATURE: core Texture2D
// EXPECT f32 0 3.0
// EXPECT f32 4 5.0
// EXPECT f32 8 0.0
// EXPECT f32 12 0.0
// EXPECT f32 16 2.0
// EXPECT f32 20 1.0
Texture2D<float4> image : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, asuint(image.Load(int3(3, 5, 0))));
  results.Store2(16, asuint(image[uint2(2, 1)].xy));
}
