// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic and
// EXPECT u32 0 1
// EXPECT u32 4 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(and(z == 0, true) ? 1u : 0u));
  results.Store(4, asuint(and(bool2(true, false), bool2(true, true)).y ? 1u : 0u));
}
