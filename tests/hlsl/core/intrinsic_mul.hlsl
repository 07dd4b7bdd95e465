// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic mul
// EXPECT f32 0 39.0
// EXPECT f32 4 34.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(mul(float2x2(1, 2, 3, 4), float2(5, 6) + z).y));
  results.Store(4, asuint(mul(float2(5, 6), float2x2(1, 2, 3, 4)).y));
}
