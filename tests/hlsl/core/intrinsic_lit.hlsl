// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic lit
// EXPECT f32 0 4.0 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(lit(0.5 + z, 2.0, 2.0).z));
}
