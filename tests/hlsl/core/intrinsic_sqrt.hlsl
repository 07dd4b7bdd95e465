// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic sqrt
// EXPECT f32 0 1.5
// EXPECT u32 4 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(sqrt(2.25 + z)));
  results.Store(4, asuint(sqrt(-1.0 + z) == 0 ? 1u : 0u));
}
