// SPDX-License-Identifier: MIT
// FEATURE: extended reversebits of 16-bit and 64-bit integers, asdouble of vectors
// OPTIONS: -enable-16bit-types
// EXPECT u32 0 0x8000 0x1234 0x8000 0xFFFF8000
// EXPECT u32 16 0 0x80000000 0xC0000000 4
// EXPECT f32 32 1.5 2 -3 4
RWByteAddressBuffer results : register(u0);

uint which(int16_t) { return 0; }
uint which(uint16_t) { return 1; }
uint which(int) { return 4; }
uint which(uint) { return 5; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const uint16_t2 both = reversebits(uint16_t2(1, 0x2C48) + uint16_t(z));
  results.Store2(0, uint2(both));
  const int16_t lowest = reversebits(int16_t(1 + z));
  results.Store2(8, uint2(uint16_t(lowest), asuint(int(lowest))));
  const uint64_t wide = reversebits(1ull + z);
  results.Store2(16, uint2(uint(wide), uint(wide >> 32)));
  const int two = reversebits(int(3 + z));  // keeps its type
  results.Store2(24, uint2(asuint(two), which(reversebits(int(z)))));
  const double4 doubles = asdouble(uint4(z, 0, 0, 0),
                                   uint4(0x3FF80000, 0x40000000, 0xC0080000, 0x40100000));
  results.Store4(32, asuint(float4(doubles)));
}
