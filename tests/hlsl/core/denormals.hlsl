// SPDX-License-Identifier: MIT
// FEATURE: core denormal arguments and results of intrinsics are zero
// Logarithms and powers
// EXPECT u32 0 0xFF800000 0xFF800000 0xFF800000 0xFF800000
// EXPECT u32 16 0 0x7F800000 0x3F800000 0x3F800000
// EXPECT u32 32 0x3F800000 0 0x00800000 0
// Roots and quotients
// EXPECT u32 48 0 0x7F800000 0x7F800000 0xFF800000 0
// Functions that are the identity near zero
// EXPECT u32 68 0 0x80000000 0 0x80000000 0 0x80000000
// EXPECT u32 92 0 0x80000000 0 0x80000000 0 0x80000000
// EXPECT u32 116 0x3F800000 0x3FC90FDB 0x3F800000
// EXPECT u32 128 0 0x80000000 0x40490FDB 0x3FC90FDB
// Parts and remainders
// EXPECT u32 144 0 0 0x80000000 0 0 0 0x80000000
// EXPECT u32 172 0 0 1 0 0x80000000 0
// Rounding, signs, lengths
// EXPECT u32 196 0x80000000 0 0 0x80000000 0 0 0
// EXPECT u32 224 0 0
// EXPECT u32 232 0x3F800000 0xBF800000
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);       // 0, known at run time only
  const float d = asfloat(0x00000001 + z);  // the smallest denormal number
  const float n = asfloat(0x80400000 + z);  // a negative one
  const float smallest = asfloat(0x00800000 + z);
  const float one = 1 + float(z);
  results.Store4(0, asuint(float4(log(d), log2(d), log10(d), log(n))));
  results.Store4(16, asuint(float4(pow(d, 2 * one), pow(d, -one), pow(d, one - 1), pow(one, n))));
  results.Store4(32, asuint(float4(exp2(d), exp2(-127 * one), exp2(-126 * one), exp(-88 * one))));
  results.Store4(48, asuint(float4(sqrt(d), rsqrt(d), rcp(d), rcp(n))));
  results.Store(64, asuint(rcp(asfloat(0x7F000000 + z))));  // 2^-127
  results.Store4(68, asuint(float4(sin(d), sin(n), tan(d), tan(n))));
  results.Store2(84, asuint(float2(asin(d), asin(n))));
  results.Store4(92, asuint(float4(atan(d), atan(n), sinh(d), sinh(n))));
  results.Store2(108, asuint(float2(tanh(d), tanh(n))));
  results.Store3(116, asuint(float3(cos(d), acos(d), cosh(d))));
  results.Store4(128, asuint(float4(atan2(d, one), atan2(n, one), atan2(d, -one), atan2(one, d))));
  float exponent, whole;
  const float mantissa = frexp(d, exponent);
  results.Store4(144, asuint(float4(mantissa, exponent, frexp(n, exponent), exponent)));
  results.Store3(160, asuint(float3(ldexp(d, 100 * one), ldexp(one, -127 * one), ldexp(n, 30))));
  results.Store2(172, asuint(float2(fmod(d, one), fmod(1.5f * smallest, smallest))));
  results.Store(180, isnan(fmod(one, d)));
  const float fraction = modf(d, whole);
  results.Store3(184, asuint(float3(fraction, fmod(n, one), whole)));
  results.Store4(196, asuint(float4(floor(n), ceil(d), trunc(d), round(n))));
  results.Store3(212, asuint(float3(frac(n), saturate(d), sign(d))));
  results.Store2(224, asuint(float2(length(float2(d, d)), degrees(d))));
  results.Store2(232, asuint(float2(one + d, n - one)));
}
