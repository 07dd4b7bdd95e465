// SPDX-License-Identifier: MIT
// FEATURE: extended ResourceDescriptorHeap
// EXPECT f32 0 3
// EXPECT f32 4 5
// EXPECT f32 8 0
// EXPECT f32 12 0
// EXPECT u32 16 9
// EXPECT u32 20 6
// EXPECT u32 24 13
// EXPECT u32 28 9
struct Words {
  uint4 first;
  uint4 second;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Texture2D<float4> image = ResourceDescriptorHeap[NonUniformResourceIndex(z)];
  results.Store4(0, asuint(image.Load(int3(3, 5, 0))));
  ByteAddressBuffer bytes = ResourceDescriptorHeap[z + 1];
  results.Store(16, bytes.Load(36));
  ConstantBuffer<Words> words = ResourceDescriptorHeap[2];
  results.Store(20, words.second.z);
  RWByteAddressBuffer same = ResourceDescriptorHeap[3];
  same.Store(24, 13u);
  ByteAddressBuffer chosen = z == 0 ? ResourceDescriptorHeap[1] : ResourceDescriptorHeap[2];
  results.Store(28, chosen.Load(36));
}
