// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic cosh
// EXPECT f32 0 1.1276259652063807 8
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(cosh(0.5 + z)));
}
