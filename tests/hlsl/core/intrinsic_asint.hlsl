// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic asint
// EXPECT u32 0 3212836864
// EXPECT u32 4 4294967295
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(asint(-1.0 + z)));
  results.Store(4, asuint(asint(4294967295u)));
}
