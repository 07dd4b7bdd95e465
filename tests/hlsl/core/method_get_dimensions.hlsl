// SPDX-License-Identifier: MIT
// FEATURE: core .GetDimensions
// EXPECT u32 0 8
// EXPECT u32 4 8
// EXPECT u32 8 4
// EXPECT u32 12 4
// EXPECT u32 16 2
// EXPECT f32 20 8.0
Texture2D<float4> image : register(t0);
ByteAddressBuffer bytes : register(t1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  uint width, height, levels;
  image.GetDimensions(width, height);
  results.Store2(0, uint2(width, height));
  image.GetDimensions(1, width, height, levels);
  results.Store3(8, uint3(width, height, levels));
  float fwidth_value, fheight;
  image.GetDimensions(fwidth_value, fheight);
  results.Store(20, asuint(fwidth_value));
}
