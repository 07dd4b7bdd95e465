// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic frexp
// EXPECT f32 0 0.75
// EXPECT f32 4 4.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float exponent;
  float mantissa = frexp(12.0 + z, exponent);
  results.Store2(0, asuint(float2(mantissa, exponent)));
}
