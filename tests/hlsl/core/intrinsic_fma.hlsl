// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic fma
// EXPECT f32 0 7.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  double d = fma(2.0l, 3.0l, (double)(1 + z));
  results.Store(0, asuint((float)d));
}
