// SPDX-License-Identifier: MIT
// FEATURE: extended intrinsics of long vectors
// OPTIONS: -T lib_6_9
// EXPECT u32 0 288 45 72 45 54 45
// EXPECT f32 24 55 6.1875
// EXPECT i32 32 -20
// EXPECT u32 36 1 0 1 0
// EXPECT f32 52 1 2 6 8 10
// EXPECT f32 72 2 0.5 -1 -0.25
// EXPECT f32 88 0.625 3
// EXPECT f32 96 1 0
// EXPECT f64 104 7.5
// EXPECT u32 112 0 1081095168
// EXPECT f32 120 4 25 9
// EXPECT u32 132 10 3 1
// EXPECT f32 144 12
RWByteAddressBuffer results : register(u0);
ByteAddressBuffer words : register(t1);

typedef vector<float, 9> Floats;
typedef vector<uint, 9> Uints;
typedef vector<int, 9> Ints;

// Component i of the result is the function of the arguments' components i.
#define SAME(type, call, one)                                     \
  {                                                               \
    const type r = call;                                          \
    for (uint i = 0; i < 9; ++i) same += asuint(r[i]) == asuint(one); \
  }
#define OF_ONE(f) SAME(Floats, f(x), f(x[i]))
#define OF_TWO(f) SAME(Floats, f(x, y), f(x[i], y[i]))
#define OF_THREE(f) SAME(Floats, f(x, y, w), f(x[i], y[i], w[i]))
#define OF_UINTS(f) SAME(Uints, f(u), f(u[i]))
#define TEST_OF(f) SAME(Uints, (Uints)f(x), (uint)f(x[i]))

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const Uints u = words.Load<Uints>(4 + z);  // 1 to 9
  const Floats x = (Floats)u * 0.1;
  const Floats y = (Floats)u * 0.25 + 0.125;
  const Floats w = 3 - (Floats)u * 0.5;
  const Ints s = (Ints)u - 5;
  uint same = 0;
  OF_ONE(acos) OF_ONE(asin) OF_ONE(atan) OF_ONE(ceil) OF_ONE(cos) OF_ONE(cosh) OF_ONE(degrees)
  OF_ONE(exp) OF_ONE(exp2) OF_ONE(floor) OF_ONE(frac) OF_ONE(log) OF_ONE(log10) OF_ONE(log2)
  OF_ONE(radians) OF_ONE(rcp) OF_ONE(round) OF_ONE(rsqrt) OF_ONE(saturate) OF_ONE(sin)
  OF_ONE(sinh) OF_ONE(sqrt) OF_ONE(tan) OF_ONE(tanh) OF_ONE(trunc) OF_ONE(abs)
  OF_TWO(atan2) OF_TWO(fmod) OF_TWO(ldexp) OF_TWO(pow) OF_TWO(step) OF_TWO(max)
  results.Store(0, same);  // 32 functions
  same = 0;
  OF_THREE(clamp) OF_THREE(lerp) OF_THREE(mad) OF_THREE(smoothstep) OF_TWO(min)
  results.Store(4, same);
  same = 0;
  OF_UINTS(countbits) OF_UINTS(firstbithigh) OF_UINTS(firstbitlow) OF_UINTS(reversebits)
  OF_UINTS(abs) OF_UINTS(asuint) OF_UINTS(f32tof16) OF_UINTS(asuint)
  results.Store(8, same);
  same = 0;
  TEST_OF(isfinite) TEST_OF(isinf) TEST_OF(isnan) TEST_OF(asuint) TEST_OF(asint)
  results.Store(12, same);
  same = 0;
  SAME(Ints, sign(s), sign(s[i])) SAME(Ints, abs(s), abs(s[i]))
  SAME(Ints, max(s, -s), max(s[i], -s[i]))
  SAME(Ints, min(s, 2), min(s[i], 2)) SAME(Floats, asfloat(u), asfloat(u[i]))
  SAME(Floats, f16tof32(u), f16tof32(u[i]))
  results.Store(16, same);
  same = 0;
  SAME(Uints, u << 3, u[i] << 3) SAME(Uints, u / 3 % 2, u[i] / 3 % 2) SAME(Ints, s >> 1, s[i] >> 1)
  SAME(Uints, (u & 6) | (u ^ 5), (u[i] & 6) | (u[i] ^ 5)) SAME(Ints, ~s, ~s[i])
  results.Store(20, same);

  // Reductions: 1 + .. + 9 and 10; sums of products of floats and of integers.
  const vector<float, 10> to_ten = {(Floats)u, 10};
  results.Store(24, dot(to_ten, (vector<float, 10>)1));
  results.Store(28, dot(y, (Floats)0.5));
  results.Store(32, dot(s, s - 2) - 80);
  results.Store4(36, uint4(all(u), all(s), any(s), any(s > 4)));

  // Choices by component.
  const vector<float, 5> chosen =
      select((vector<bool, 5>)(u > 2), (vector<float, 5>)u * 2, (vector<float, 5>)u);
  results.Store(52, chosen);

  // Functions with outputs.
  vector<float, 5> whole, sine, cosine;
  const vector<float, 5> mixed = {2.5, -1.25, 3, 0, z};
  const vector<float, 5> fraction = modf(mixed, whole);
  results.Store(72, float4(whole[0], fraction[0], whole[1], fraction[1]));
  vector<float, 5> exponent;
  const vector<float, 5> mantissa = frexp(vector<float, 5>(1, 5, 1, 1, 1) + z, exponent);
  results.Store2(88, asuint(float2(mantissa[1], exponent[1])));
  sincos(mixed, sine, cosine);
  results.Store2(96, asuint(float2(cosine[3], sine[3])));

  // Doubles.
  const vector<double, 5> doubles = (vector<double, 5>)mixed;
  const vector<double, 5> fused = fma(doubles, doubles, (vector<double, 5>)1.25);
  results.Store<double>(104, fused[0]);
  vector<uint, 5> low, high;
  asuint(fused + 249, low, high);
  results.Store2(112, uint2(low[2] + z, high[2]));
  results.Store(120, float3(pow(mixed, 2)[0] - 2.25, pow(mixed + 2, 2)[2], (mixed * mixed)[2]));

  // Logical functions, and scalars beside vectors.
  const vector<bool, 9> odd = (vector<bool, 9>)(u & 1);
  const uint both = dot((Uints)and(odd, u > 1), 2);
  results.Store3(132, uint3(both + 2, dot((Uints)or(odd, u > 8), 1) - 2, all(or(odd, !odd))));
  results.Store(144, mul((Floats)u, (Floats)0.25) + 0.75);
}
