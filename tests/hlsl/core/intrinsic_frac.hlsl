// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic frac
// EXPECT f32 0 0.75
// EXPECT f32 4 0.75
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(frac(1.75 + z)));
  results.Store(4, asuint(frac(-1.25)));
}
