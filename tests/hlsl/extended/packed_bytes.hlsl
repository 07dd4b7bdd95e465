// SPDX-License-Identifier: MIT
// FEATURE: extended packed 8-bit numbers
// OPTIONS: -enable-16bit-types
// Low bytes: 0x1FF is 0xFF, 256 is 0, -1 is 0xFF, -129 is 0x7F.
// EXPECT u32 0 0x030200FF 0x7F80FFFF
// Clamped to 0 to 255, and to -128 to 127:
// EXPECT u32 8 0x00FF7F00 0x807F7F81
// From 16 bits:
// EXPECT u32 16 0x04FF0201 0xFFFE0380 0xFF00FF07 0x7F80F907
// The first component is the lowest byte.
// EXPECT u32 32 0xFF 0x80 0x7F 0x01
// EXPECT i32 48 -1 -128 127 1
// EXPECT u32 64 0xFF 0x80 0x7F 0x01
// EXPECT i32 80 -1 -128 127 1
// There and back, through variables of the packed types; and their size.
// EXPECT u32 96 0x7F8001FE 0xFE 4
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const int i = int(z);
  results.Store(0, pack_u8(uint4(0x1FF, 256, 2, 3) + z));
  results.Store(4, pack_s8(int4(-1, 255, -128, -129) + i));
  results.Store(8, pack_clamp_u8(int4(-5, 127, 300, -2147483648) + i));
  results.Store(12, pack_clamp_s8(int4(-127, 127, 300, -2147483648) + i));
  results.Store(16, pack_u8(uint16_t4(0x201, 2, 0xFF, 4) + uint16_t(z)));
  results.Store(20, pack_s8(int16_t4(-128, 3, -2, -1) + int16_t(i)));
  results.Store(24, pack_clamp_u8(int16_t4(7, 256, -9, 32767) + int16_t(i)));
  results.Store(28, pack_clamp_s8(int16_t4(7, -7, -32768, 32767) + int16_t(i)));
  const uint8_t4_packed bytes = 0x017F80FF + z;
  const int8_t4_packed signed_bytes = 0x017F80FF + z;
  results.Store4(32, unpack_u8u32(bytes));
  results.Store4(48, asuint(unpack_s8s32(signed_bytes)));
  results.Store4(64, uint4(unpack_u8u16(bytes)));
  results.Store4(80, asuint(int4(unpack_s8s16(signed_bytes))));
  const int8_t4_packed packed = pack_clamp_s8(int4(-2, 1, -129, 128) + i);
  results.Store3(96, uint3(packed, unpack_u8u32(packed).x, sizeof(bytes)));
}
