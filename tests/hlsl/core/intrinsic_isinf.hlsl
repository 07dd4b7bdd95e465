// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic isinf
// EXPECT u32 0 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(isinf(asfloat(0x7f800000 + z)) ? 1u : 0u));
}
