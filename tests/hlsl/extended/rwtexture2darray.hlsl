// SPDX-License-Identifier: MIT
// FEATURE: extended RWTexture2DArray
// EXPECT u32 0 1
RWTexture2DArray<float4> layers : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  if (z == 1) {
    layers[uint3(1, 2, 1)] = 4;
    results.Store(4, asuint(layers[uint3(1, 2, 1)].x));
  }
  results.Store(0, 1);
}
