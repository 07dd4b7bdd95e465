// SPDX-License-Identifier: MIT
// TRAP: 11 other intrinsics
// EXPECT i32 0 -1
// EXPECT i32 4 0
// EXPECT i32 8 31
// EXPECT i32 12 30
// EXPECT u32 16 15360
// EXPECT u32 20 15362
// EXPECT u32 24 31744
// EXPECT u32 28 31743
// EXPECT u32 32 1
// EXPECT u32 36 0
// EXPECT u32 40 64512
// EXPECT u32 44 1
// EXPECT f32 48 5.9604644775390625e-08
// EXPECT f32 52 inf
// EXPECT f32 56 nan
// EXPECT f32 60 2
// EXPECT f32 64 2
// EXPECT f32 68 -0
// EXPECT f32 72 -2
// EXPECT f32 76 -1
// EXPECT f32 80 -0.25
// EXPECT f32 84 0.5
// EXPECT f32 88 4
// EXPECT f32 92 nan
// EXPECT f32 96 inf
// EXPECT f32 100 -inf
// EXPECT f32 104 0
// EXPECT f32 108 3.14159274 1
// EXPECT f32 112 3.14159274 1
// EXPECT f32 116 -1.57079637 1
// EXPECT u32 120 0
// EXPECT u32 124 3221225472
// EXPECT f32 128 10
// EXPECT f32 132 1
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const int minus = -1 + (int)z;
  results.Store4(0, asuint(int4(firstbithigh(minus), firstbithigh(minus - 1), firstbithigh(0x80000000u + z), firstbithigh(0x7fffffff + (int)z))));
  // Rounds to nearest, ties to even; overflows to infinity; has denormals.
  results.Store4(16, f32tof16(float4(1.00048828125, 1.00146484375, 65520, 65519.996) + z));
  results.Store4(32, f32tof16(asfloat(uint4(0x33800000, 0x33000000, 0xff800000, 0x33800000) + z)));
  results.Store3(48, asuint(f16tof32(uint3(1, 0x7c00, 0x7c01) + z)));
  results.Store4(60, asuint(round(float4(1.5, 2.5, -0.5, -1.5) + z * 1.0)));
  float whole;
  const float part = modf(-1.25 + z, whole);
  float exponent;
  const float mantissa = frexp(8.0 + z, exponent);
  results.Store4(76, asuint(float4(whole, part, mantissa, exponent)));
  results.Store4(92, asuint(float4(pow(-2.0 + z, 0.5), rsqrt(0.0 + z), log(0.0 + z), exp2(-200.0 + z))));
  results.Store3(108, asuint(float3(atan2(0.0 + z, -1.0), atan2(asfloat(0x80000000 + z), -1.0), atan2(-1.0, 0.0 + z))));
  uint low, high;
  asuint(-2.0L, low, high);
  results.Store2(120, uint2(low, high));
  results.Store2(128, asuint(float2(mul(2.0, 5.0 + z), smoothstep(0.0, 1.0, 2.0 + z))));
}
