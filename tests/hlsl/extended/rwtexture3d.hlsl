// SPDX-License-Identifier: MIT
// FEATURE: extended RWTexture3D
// EXPECT f32 0 3
// EXPECT f32 4 4
// EXPECT f32 8 0
// EXPECT f32 12 1
// EXPECT f32 16 10
// EXPECT f32 20 0
// EXPECT f32 24 0
// EXPECT f32 28 1
// EXPECT u32 32 8
// EXPECT u32 36 8
// EXPECT u32 40 2
RWTexture3D<float4> volume_3d : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, asuint(volume_3d[uint3(3, 4, 1)]));
  volume_3d[uint3(7, 0, 1)].x += 3;
  results.Store4(16, asuint(volume_3d[uint3(7, 0, 1)]));
  uint width, height, depth;
  volume_3d.GetDimensions(width, height, depth);
  results.Store3(32, uint3(width, height, depth));
}
