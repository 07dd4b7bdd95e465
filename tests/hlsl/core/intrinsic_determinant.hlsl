// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic determinant
// EXPECT f32 0 -2.0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(determinant(float2x2(1, 2, 3, 4) + z)));
}
