// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic modf
// EXPECT f32 0 -0.75
// EXPECT f32 4 -2.0
// EXPECT f32 8 0.25
// EXPECT u32 12 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float whole;
  float part = modf(-2.75 + z, whole);
  results.Store2(0, asuint(float2(part, whole)));
  int2 wholes;
  float2 parts = modf(float2(1.5, 3.25), wholes);
  results.Store(8, asuint(parts.y));
  results.Store(12, asuint(wholes.y));
}
