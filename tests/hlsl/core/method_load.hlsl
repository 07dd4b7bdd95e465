// SPDX-License-Identifier: MIT
// FEATURE: core .Load
// EXPECT f32 0 4.0
// EXPECT u32 4 2
// EXPECT u32 8 6
// EXPECT f32 12 3.0
Texture2D<float4> image : register(t0);
ByteAddressBuffer bytes : register(t1);
StructuredBuffer<uint> words : register(t2);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, asuint(image.Load(int3(4, 1, 0)).x));
  results.Store(4, bytes.Load(8));
  results.Store(8, words.Load(6));
  results.Store(12, asuint(image.Load(int3(1, 1, 0), int2(2, 0)).x));
}
