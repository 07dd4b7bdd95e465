// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic firstbithigh
// EXPECT u32 0 4
// EXPECT u32 4 4294967295
// EXPECT u32 8 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(firstbithigh(0x10u + z)));
  results.Store(4, asuint(firstbithigh(0u)));
  results.Store(8, asuint(firstbithigh(-2)));
}
