// SPDX-License-Identifier: MIT
// FEATURE: core hexadecimal float literal
// EXPECT u32 0 0x3F7FFFFF
// EXPECT f32 4 12
// EXPECT f32 8 -0.5
// EXPECT f32 12 16
// EXPECT u32 16 0x00800000
// EXPECT u32 20 0x7F7FFFFF
// EXPECT u32 24 0x3F800002
// EXPECT u32 28 0x3F800001
// EXPECT u32 32 1
// EXPECT f32 36 5.75
// EXPECT u32 40 0x3FB99999
// EXPECT u32 44 0x9999999A
RWByteAddressBuffer results : register(u0);

static const float kOneMinusEpsilon = 0x1.fffffep-1;

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(min(kOneMinusEpsilon, 2.0f + z)));
  results.Store(4, asuint(0x1.8p3f + z));
  results.Store(8, asuint(-0X.8P0 + z));
  results.Store(12, asuint(0x1p+4h + z));
  results.Store(16, asuint(0x1p-126f) + z);
  results.Store(20, asuint(0x1.fffffep127f) + z);
  // Halfway between two floats: to the even one. A bit more decides, however far behind it stands.
  results.Store(24, asuint(0x1.000003p0f) + z);
  results.Store(28, asuint(0x1.00000100000000000000000001p0f) + z);
  // Without a suffix the number takes the type of the other operand.
  const double d = 0x1.0000000000001p0;
  results.Store(32, d + z != 1.0L ? 1u : 0u);
  results.Store(36, asuint(float2(0x2.Cp1, z).x + 0x40p-8));
  uint low, high;
  asuint(0x1.999999999999ap-4 + (double)z, low, high);
  results.Store2(40, uint2(high, low));
}
