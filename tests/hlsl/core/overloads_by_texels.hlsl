// SPDX-License-Identifier: MIT
// FEATURE: core overloads that differ in the texels of a resource only
// EXPECT u32 0 1
// EXPECT u32 4 2
// EXPECT u32 8 3
// EXPECT u32 12 4
// EXPECT u32 16 5
RWByteAddressBuffer results : register(u0);
Texture2D image : register(t0);
Texture2D<half4> half_image : register(t1);
Texture2D<min16float4> min_image : register(t2);
Buffer<float2> texels : register(t3);
Buffer<half2> half_texels : register(t4);

uint f(Texture2D t) { return 1; }
uint f(Texture2D<half4> t) { return 2; }
uint f(Texture2D<min16float4> t) { return 3; }
uint f(Buffer<float2> b) { return 4; }
uint f(Buffer<half2> b) { return 5; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, uint4(f(image), f(half_image), f(min_image), f(texels)) + z);
  results.Store(16, f(half_texels) + z);
}
