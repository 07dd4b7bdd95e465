// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic exp
// EXPECT f32 0 2.718281828459045 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(exp(1.0 + z)));
}
