// SPDX-License-Identifier: MIT
// FEATURE: core special cases of intrinsics
// As in runtime/hlsl/INTRINSICS.md. min, max, clamp, saturate:
// EXPECT f32 0 1 1 nan -2 0 0 1 1
// sign, step, smoothstep:
// EXPECT f32 32 0 0 -1 1 1 1 0 1 0
// pow, exp, exp2, log2, log, log10:
// EXPECT f32 68 nan nan 9 inf 0 nan nan 0 0 inf inf 0 -inf -inf nan inf
// sqrt, rsqrt, rcp:
// EXPECT f32 132 -0.0 nan inf -inf 0 nan inf -inf 0
// frac, fmod, round, trunc:
// EXPECT f32 168 0.99999994 nan 0.75 5 -1.5 nan nan 0 2 -2 -0.0
// frexp, modf, ldexp:
// EXPECT f32 212 0.75 2 0 0 0.5 129 -0.5 -2 nan inf 0 0 inf
// sin, cos, tan, asin, acos, atan, atan2:
// EXPECT f32 264 nan nan nan nan nan
// EXPECT f32 284 1.5707964 2
// EXPECT f32 288 1.5707964 2
// EXPECT f32 292 3.1415927 2
// sinh, cosh, tanh:
// EXPECT f32 296 inf -inf inf 1 -1
// normalize, length, distance, refract, faceforward, lit, dst:
// EXPECT f32 316 nan 0 inf 0 nan 0 0 -1 nan 0 nan 1
// f32tof16, f16tof32, firstbithigh, firstbitlow, countbits, reversebits:
// EXPECT u32 364 0x7C00 0x7C00 0 0x7F800000 0x33800000
// EXPECT i32 384 -1 -1 -1 0 -1
// EXPECT u32 404 32 0x80000000
RWByteAddressBuffer results : register(u0);

static uint at = 0;
void put(float x) {
  results.Store(at, asuint(x));
  at += 4;
}
void put_bits(uint x) {
  results.Store(at, x);
  at += 4;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint zero = results.Load(65532);  // 0, known at run time only
  const float z = zero;
  const float inf = asfloat(0x7F800000 + zero), nan = asfloat(0x7FC00000 + zero);
  const float minus = asfloat(0x80000000 + zero);  // -0

  put(min(nan, 1 + z));
  put(max(1 + z, nan));
  put(min(nan, nan));
  put(clamp(nan, -2 + z, 3));
  put(saturate(nan));
  put(saturate(-inf));
  put(saturate(inf));
  put(clamp(5 + z, 3, 1));

  put(sign(nan));
  put(sign(minus));
  put(sign(-inf));
  put(step(nan, 1));
  put(step(1, nan));
  put(step(z, minus));
  put(smoothstep(1, 1 + z, 1));
  put(smoothstep(1, 1 + z, 2));
  put(smoothstep(1, 1 + z, 0));

  put(pow(z, z));
  put(pow(z - 2, z + 3));
  put(pow(z - 3, 2));  // the number 2 makes it a product
  put(pow(z, z - 1));
  put(pow(z, z + 2));
  put(pow(z + 1, inf));
  put(pow(inf, z));
  put(pow(inf, z - 1));
  put(exp(-inf));
  put(exp(z + 89));
  put(exp2(z + 128));
  put(exp2(z - 127));
  put(log2(z));
  put(log(minus));
  put(log(z - 1));
  put(log10(inf));

  put(sqrt(minus));
  put(sqrt(z - 1));
  put(rsqrt(z));
  put(rsqrt(minus));
  put(rsqrt(inf));
  put(rsqrt(z - 1));
  put(rcp(z));
  put(rcp(minus));
  put(rcp(inf));

  put(frac(z - 1e-10));
  put(frac(inf));
  put(frac(z - 1.25));
  put(fmod(z + 5, inf));
  put(fmod(z - 5.5, 2));
  put(fmod(z + 1, z));
  put(fmod(inf, 2));
  put(round(z + 0.5));
  put(round(z + 1.5));
  put(round(z - 2.5));
  put(trunc(z - 0.5));

  float part;
  put(frexp(z - 3, part));
  put(part);
  put(frexp(minus, part));
  put(part);
  put(frexp(-inf, part));
  put(part);
  put(modf(z - 2.5, part));
  put(part);
  put(modf(inf, part));
  put(part);
  put(ldexp(z, 200));
  put(ldexp(z + 1, -149));
  put(ldexp(z + 1, 128));

  put(sin(inf));
  put(cos(-inf));
  put(tan(nan));
  put(asin(z + 1.5));
  put(acos(z - 1.5));
  put(atan(inf));
  put(atan2(z, z));
  put(atan2(minus, z - 1));
  put(sinh(z + 100));
  put(sinh(z - 100));
  put(cosh(z - 100));
  put(tanh(z + 100));
  put(tanh(-inf));

  put(normalize(float2(z, z)).x);
  put(normalize(float2(z + 1e30, z)).x);
  put(length(float2(z + 1e30, z)));
  put(length(float2(minus, z)));
  put(distance(float2(inf, z), float2(inf, z)));
  put(refract(float2(nan, z), float2(z, 1), 1.5).x);
  put(refract(float2(z + 1, z), float2(z, 1), 1.5).x);
  put(faceforward(float2(1, 2), float2(z + 1, z), float2(z, 1)).x);
  put(lit(nan, 1, 1).y);
  put(lit(z - 1, 2, 2).z);
  put(lit(z + 1, z, z).z);
  put(dst(float4(5, 6, 7, 8) + z, float4(1, 2, 3, 4)).x);

  put_bits(f32tof16(z + 65520));
  put_bits(f32tof16(inf));
  put_bits(f32tof16(z + 1e-8));
  put_bits(asuint(f16tof32(zero + 0x7C00)));
  put_bits(asuint(f16tof32(zero + 1)));
  put_bits(firstbithigh(zero));
  put_bits(firstbithigh((int)zero));
  put_bits(firstbithigh((int)zero - 1));
  put_bits(firstbithigh((int)zero - 2));
  put_bits(firstbitlow(zero));
  put_bits(countbits(~zero));
  put_bits(reversebits(zero + 1));
}
