// SPDX-License-Identifier: MIT
// TRAP: 11 other intrinsics
// EXPECT f32 0 0.75
// EXPECT f32 4 0.0
// EXPECT i32 8 -1
// EXPECT u32 12 4294967295
// EXPECT u32 16 4294967295
// EXPECT u32 20 15360
// EXPECT f32 24 0.0
// EXPECT f32 28 1.0
// EXPECT f32 32 7.0
// EXPECT i32 36 32
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store2(0, asuint(float2(frac(-0.25 + z), round(0.5 + z))));
  results.Store(8, asuint(sign(-0.5 + z)));
  results.Store2(12, uint2(firstbithigh(z), firstbitlow(z)));
  results.Store(20, f32tof16(1.00048828125 + z));
  float s, c;
  sincos(z, s, c);
  results.Store2(24, asuint(float2(s, c)));
  results.Store(32, asuint(mad(2.0, 3.0, 1.0 + z)));
  results.Store(36, asuint(dot(int3(1, 2, 3), int3(4, 5, 6))));
}
