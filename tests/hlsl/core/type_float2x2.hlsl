// SPDX-License-Identifier: MIT
// FEATURE: core float2x2
// EXPECT f32 0 15.0
// EXPECT f32 4 22.0
// EXPECT f32 8 9.0
// EXPECT f32 12 16.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float2x2 m = float2x2(1, 2, 3, 4) + z;
  results.Store2(0, asuint(mul(m, m)[1]));
  results.Store2(8, asuint((m * m)[1]));
}
