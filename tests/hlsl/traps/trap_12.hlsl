// SPDX-License-Identifier: MIT
// TRAP: 12 textures with separate samplers
// EXPECT f32 0 2.0
// EXPECT f32 4 6.0
// EXPECT f32 8 5.0
// EXPECT f32 12 6.0
// EXPECT f32 16 2.0
// EXPECT f32 20 1.0
Texture2D<float4> a : register(t0);
Texture2D<float2> b : register(t1);
SamplerState point_sampler : register(s0);
float4 read(Texture2D<float4> image, SamplerState how, float2 at) {
  return image.SampleLevel(how, at, 0);
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Texture2D<float4> local_image = a;
  results.Store2(0, asuint(read(local_image, point_sampler, float2(0.3125, 0.8125)).xy));
  results.Store2(8, asuint(b.Load(int3(5, 6, 0))));
  results.Store(16, asuint(b[uint2(1, 2)].y));
  results.Store(20, asuint(a.mips[1][uint2(3, 2)].z));
}
