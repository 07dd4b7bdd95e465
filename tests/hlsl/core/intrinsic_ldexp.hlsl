// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic ldexp
// EXPECT f32 0 12.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(ldexp(1.5 + z, 3)));
}
