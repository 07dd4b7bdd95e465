// SPDX-License-Identifier: MIT
// FEATURE: extended RWTexture2DArray
// EXPECT f32 0 3
// EXPECT f32 4 4
// EXPECT f32 8 0
// EXPECT f32 12 1
// EXPECT f32 16 3
// EXPECT f32 20 4
// EXPECT f32 24 7
// EXPECT f32 28 0
// EXPECT f32 32 0
// EXPECT f32 36 0
// EXPECT f32 40 0
// EXPECT f32 44 0
// EXPECT u32 48 8
// EXPECT u32 52 8
// EXPECT u32 56 2
RWTexture2DArray<float4> layers_array : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, asuint(layers_array[uint3(3, 4, 1)]));
  layers_array[uint3(3, 4, 0)].z = 7;
  layers_array[uint3(3, 4, 2)] = 9;  // there is no such element, so nothing is written
  results.Store4(16, asuint(layers_array[uint3(3, 4, 0)]));
  results.Store4(32, asuint(layers_array[uint3(3, 4, 2)]));
  uint width, height, elements;
  layers_array.GetDimensions(width, height, elements);
  results.Store3(48, uint3(width, height, elements));
}
