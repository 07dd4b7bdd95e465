// SPDX-License-Identifier: MIT
// FEATURE: core hex/uint suffix literals
// EXPECT u32 0 255
// EXPECT u32 4 16
// EXPECT u32 8 15
// EXPECT u32 12 4000000000
// EXPECT u32 16 4294967295
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store4(0, uint4(0xFFu, 0x10, 017, 4000000000));
  results.Store(16, 3u - 4u + z);
}
