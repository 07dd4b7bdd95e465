// SPDX-License-Identifier: MIT
// TRAP: 8 integers and floats
// EXPECT u32 0 2
// EXPECT i32 4 -4
// EXPECT u32 8 4294967295
// EXPECT u32 12 4294967295
// EXPECT f32 16 -1.5
// EXPECT i32 20 -3
// EXPECT u32 24 0
// EXPECT u32 28 2147483647
// EXPECT u32 32 0
// EXPECT u32 36 4294967295
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint s = 33 + z;
  results.Store(0, 1u << s);
  results.Store(4, asuint(-8 >> 1));
  uint zero_divisor = z;
  results.Store2(8, uint2(5u / zero_divisor, 5u % zero_divisor));
  results.Store(16, asuint((-7.5 + z) % 2));
  results.Store(20, asuint((-7 + (int)z) % 4));
  results.Store4(24, uint4((uint)(-1.0 + z), asuint((int)(3e10 + z)), asuint((int)asfloat(0x7fc00000 + z)), (uint)(5e9 + z)));
}
