// SPDX-License-Identifier: MIT
// FEATURE: core components of texels whose index is known at run time only
// EXPECT i32 0 99 8 4
// EXPECT f32 12 3 7 0 -1
// EXPECT f32 28 6 3
RWBuffer<int4> texels : register(u1);
RWTexture2D<float4> image : register(u2);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  texels[2][z] = 99;
  texels[3][z] += 5;
  results.Store3(0, asuint(int3(texels[2].x, texels[3].x, texels[4][z].x)));
  image[uint2(3, 2)][3 + z] = -1;
  image[uint2(3, 2)][1 + z].x += 5;
  results.Store4(12, asuint(image[uint2(3, 2)]));
  uint i = z;
  image[uint2(5, 3)][i++] += 1;  // the index is evaluated once
  results.Store2(28, asuint(image[uint2(5, 3)].xy));
}
