// SPDX-License-Identifier: MIT
// FEATURE: core static const global
// EXPECT f32 0 2.5
// EXPECT u32 4 7
// EXPECT u32 8 3
// EXPECT f32 12 7.5
static const float kScale = 2.5;
static const uint kTable[3] = {5, 6, 7};
static const uint kSize = sizeof(float3) + 4;
static const float3 kVector = float3(1, 2, 3) * kScale;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint big[kSize];
  big[kSize - 1] = 3;
  results.Store(0, asuint(kScale));
  results.Store2(4, uint2(kTable[z + 2], big[15]));
  results.Store(12, asuint(kVector.z));
}
