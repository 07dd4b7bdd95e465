// SPDX-License-Identifier: MIT
// FEATURE: extended SamplerDescriptorHeap
// EXPECT f32 0 7
// EXPECT f32 4 2
Texture2D image : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  for (uint i = 0; i < 2; ++i) {
    SamplerState chosen = SamplerDescriptorHeap[NonUniformResourceIndex(i)];
    results.Store(4 * i, asuint(image.SampleLevel(chosen, float2(1.3125, 0.5), 0).x));  // clamp, wrap
  }
}
