// SPDX-License-Identifier: MIT
// FEATURE: extended packed 8-bit numbers without types of 16 bits
// unpack_u8u16 and unpack_s8s16 give min16uint4 and min16int4.
// EXPECT u32 0 0xFF 0x80 0x7F 0x01
// EXPECT i32 16 -1 -128 127 1
// EXPECT i32 32 -2 -256 254 2
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const uint8_t4_packed bytes = 0x017F80FF + z;
  const int8_t4_packed signed_bytes = 0x017F80FF + z;
  results.Store4(0, unpack_u8u16(bytes));
  results.Store4(16, asuint(int4(unpack_s8s16(signed_bytes))));
  const min16int4 twice = unpack_s8s16(signed_bytes) * 2;
  results.Store4(32, asuint(int4(twice)));
}
