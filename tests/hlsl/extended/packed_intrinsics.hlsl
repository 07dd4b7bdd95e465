// SPDX-License-Identifier: MIT
// FEATURE: extended AddUint64, dot2add, dot4add_u8packed, dot4add_i8packed
// OPTIONS: -enable-16bit-types
// EXPECT u32 0 0 3 4 5
// EXPECT u32 16 0xFFFFFFFF 0xFFFFFFFF
// EXPECT f32 24 18.5
// EXPECT f32 28 65505
// EXPECT u32 32 260107
// EXPECT i32 36 -30
// EXPECT i32 40 65537
// EXPECT u32 44 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  // 0xFFFFFFFF + 2^32 + 1 and 2^33 + 3 + 3 * 2^32 + 1.
  results.Store4(0, AddUint64(uint4(0xFFFFFFFF, 1, 3, 2) + z, uint4(1, 1, 1, 3)));
  results.Store2(16, AddUint64(uint2(z, 0), uint2(0xFFFFFFFF, 0xFFFFFFFF)));
  results.Store(24, asuint(dot2add(half2(1.5, 2) + half(z), half2(3, 4), 6.0f)));
  // The sum is not rounded to half: 256 * 256 - 31.
  results.Store(28, asuint(dot2add(half2(256, 1) + half(z), half2(256, -31), 0.0f)));
  // 4 * 255 * 255 + 7; 127 * 2 + (-128) * 2 + (-1) * 28 + 0; 4 * (-128) * (-128) + 1.
  results.Store(32, dot4add_u8packed(0xFFFFFFFF - z, 0xFFFFFFFF, 7));
  results.Store(36, asuint(dot4add_i8packed(0x00FF807F + z, 0x011C0202, 0)));
  results.Store(40, asuint(dot4add_i8packed(0x80808080 + z, 0x80808080, 1)));
  results.Store(44, dot4add_u8packed(0x01000100 + z, 0x010000FF, 2u));
}
