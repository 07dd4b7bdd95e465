// SPDX-License-Identifier: MIT
// FEATURE: extended uint16_t scalar/vec
// OPTIONS: -enable-16bit-types -T lib_6_6
// EXPECT u32 0 1
// EXPECT u32 4 49152
// EXPECT u32 8 0
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint16_t a = (uint16_t)(65535 + z);
  a = a + (uint16_t)2;
  results.Store(0, a);
  uint16_t2 b = uint16_t2(3, 4) << 14;
  results.Store2(4, (uint2)b);
}
