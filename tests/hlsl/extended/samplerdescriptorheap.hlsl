// SPDX-License-Identifier: MIT
// FEATURE: extended SamplerDescriptorHeap
// EXPECT u32 0 1
Texture2D image : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  if (z == 1) {
    SamplerState chosen = SamplerDescriptorHeap[2];
    results.Store(4, asuint(image.SampleLevel(chosen, 0.5, 0).x));
  }
  results.Store(0, 1);
}
