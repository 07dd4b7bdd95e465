// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic all
// EXPECT u32 0 1
// EXPECT u32 4 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(all(bool2(true, z == 0)) ? 1u : 0u));
  results.Store(4, asuint(all(float2(1, z)) ? 1u : 0u));
}
