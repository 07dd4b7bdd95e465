// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic sincos
// EXPECT f32 0 0.479425538604203 4
// EXPECT f32 4 0.8775825618903728 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  float s, c;
  sincos(0.5 + z, s, c);
  results.Store2(0, asuint(float2(s, c)));
}
