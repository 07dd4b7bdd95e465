// SPDX-License-Identifier: MIT
// TRAP: 9 NaN in min, max, saturate
// EXPECT f32 0 1.0
// EXPECT f32 4 2.0
// EXPECT f32 8 0.0
// EXPECT f32 12 3.0
// EXPECT u32 16 1
// EXPECT u32 20 0
// EXPECT u32 24 1
// EXPECT u32 28 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float nan = asfloat(0x7fc00000 + z);
  results.Store4(0, asuint(float4(min(nan, 1), max(2, nan), saturate(nan), clamp(nan, 3, 4))));
  results.Store3(16, uint3(isnan(nan), nan == nan, nan != nan));
  results.Store(28, isnan(nan + 1));
}
