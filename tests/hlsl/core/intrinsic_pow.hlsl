// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic pow
// EXPECT f32 0 8.0 4
// EXPECT f32 4 3.0 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(pow(2.0 + z, 3)));
  results.Store(4, asuint(pow(float2(9, 4), 0.5).x));
}
