// SPDX-License-Identifier: MIT
// FEATURE: extended ResourceDescriptorHeap
// EXPECT u32 0 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  if (z == 1) {
    RWByteAddressBuffer other = ResourceDescriptorHeap[3];
    other.Store(0, 1u);
    Texture2D<float4> image = ResourceDescriptorHeap[NonUniformResourceIndex(z)];
    results.Store(4, asuint(image[uint2(0, 0)].x));
  }
  results.Store(0, 1);
}
