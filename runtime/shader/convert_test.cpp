// SPDX-License-Identifier: MIT
#include "kaamos/shader/convert.h"

#include "runtime/shader/test_values.h"

namespace kaamos::shader {
namespace {

// Rounds to nearest even on a grid of 2^-24 to 2^5, by definition rather than by bit tricks.
double half_reference(double x) {
  if (std::isnan(x) || std::isinf(x) || x == 0) return x;
  int exponent;
  std::frexp(x, &exponent);
  const double step = std::ldexp(1.0, std::max(exponent - 1, -14) - 10);
  const double rounded = std::nearbyint(x / step) * step;
  return std::abs(rounded) > 65504 ? std::copysign(static_cast<double>(kInf), x) : rounded;
}

TEST(ShaderHalf, EveryHalfSurvivesTheRoundTrip) {
  for (uint32_t bits = 0; bits < 0x10000; ++bits) {
    const half h{static_cast<uint16_t>(bits)};
    const float f = to_float(h);
    if (std::isnan(f)) {
      EXPECT_EQ(to_half(f).bits, bits | 0x200u);
      continue;
    }
    EXPECT_EQ(to_half(f).bits, bits);
    EXPECT_EQ(to_half(static_cast<double>(f)).bits, bits);
    const uint32_t exponent = bits >> 10 & 31u, fraction = bits & 1023u;
    const double magnitude = exponent == 31  ? static_cast<double>(kInf)
                             : exponent == 0 ? fraction * 0x1p-24
                                             : std::ldexp(1024.0 + fraction, int(exponent) - 25);
    EXPECT_EQ(static_cast<double>(f), (bits & 0x8000u) != 0 ? -magnitude : magnitude) << bits;
  }
}

TEST(ShaderHalf, RoundsToNearestEven) {
  uint32_t state = 1;
  for (int i = 0; i < 200000; ++i) {
    state = state * 1664525u + 1013904223u;
    // Mostly exponents that a half can represent.
    const uint32_t bits = (i & 7) == 0 ? state : 0x30000000u + state % 0x20000000u;
    const float x = std::bit_cast<float>(bits);
    if (std::isnan(x)) continue;
    EXPECT_EQ(static_cast<double>(to_float(to_half(x))), half_reference(static_cast<double>(x)))
        << x;
  }
  for (const float x : {65519.0f, 65520.0f, 65536.0f, 1e30f, 0x1p-25f, 0x1.000002p-25f, 0x1p-24f,
                        0x1.8p-24f, 6.1e-5f, -65520.0f, 0.33325195f}) {
    EXPECT_EQ(static_cast<double>(to_float(to_half(x))), half_reference(static_cast<double>(x)))
        << x;
  }
}

// [D3D11.3 3.2.2] Of a finite number, the nearest half that is not further from zero.
TEST(ShaderHalf, TexelsRoundTowardZero) {
  const auto next = [](half h) { return to_float({static_cast<uint16_t>(h.bits + 1)}); };
  for (uint32_t bits = 0x30000000u; bits < 0x47800000u; bits += 0x3C1u) {
    const float x = std::bit_cast<float>(bits);
    const half h = to_half_toward_zero(x);
    EXPECT_LE(to_float(h), x);
    EXPECT_GT(h.bits == 0x7BFF ? kInf : next(h), x);
    EXPECT_EQ(to_half_toward_zero(-x).bits, h.bits | 0x8000);
  }
  for (const float x : {65504.0f, 65519.0f, 65520.0f, 65536.0f, 1e30f}) {
    EXPECT_EQ(to_half_toward_zero(x).bits, 0x7BFF);
    EXPECT_EQ(to_half_toward_zero(-x).bits, 0xFBFF);
  }
  EXPECT_EQ(to_half_toward_zero(kInf).bits, 0x7C00);
  EXPECT_EQ(to_half_toward_zero(-kInf).bits, 0xFC00);
  EXPECT_GT(to_half_toward_zero(std::nanf("")).bits & 0x7FFF, 0x7C00);
  EXPECT_EQ(to_half_toward_zero(-0.0f).bits, 0x8000);
}

TEST(ShaderHalf, DoubleIsRoundedOnce) {
  // Rounding to float first would give the tie 1 + 2^-11, which then rounds down to 1.
  EXPECT_EQ(to_half(1.0 + 0x1p-11 + 0x1p-40).bits, 0x3C01);
  EXPECT_EQ(to_half(1.0 + 0x1p-11 - 0x1p-40).bits, 0x3C00);
  EXPECT_EQ(to_half(-(1.0 + 0x1p-11 + 0x1p-40)).bits, 0xBC01);
  EXPECT_EQ(to_half(1e300).bits, 0x7C00);
  EXPECT_EQ(to_half(-1e300).bits, 0xFC00);
  EXPECT_EQ(to_half(1e-300).bits, 0x0000);
}

TEST(ShaderConvert, FloatToIntegerTruncatesAndClamps) {
  for (const float x : kFloats) {
    const double d = static_cast<double>(x);
    const double t = std::isnan(d) ? 0 : std::trunc(d);
    EXPECT_EQ(convert<int32_t>(x),
              static_cast<int32_t>(std::min(std::max(t, -2147483648.0), 2147483647.0)))
        << x;
    EXPECT_EQ(convert<uint32_t>(x), static_cast<uint32_t>(std::min(std::max(t, 0.0), 4294967295.0)))
        << x;
    EXPECT_EQ(convert<int16_t>(x), static_cast<int16_t>(std::min(std::max(t, -32768.0), 32767.0)))
        << x;
    EXPECT_EQ(convert<uint16_t>(x), static_cast<uint16_t>(std::min(std::max(t, 0.0), 65535.0)))
        << x;
    EXPECT_EQ(convert<bool>(x), x != 0.0f) << x;
  }
  EXPECT_EQ(convert<int32_t>(2147483520.0f), 2147483520);
  EXPECT_EQ(convert<int32_t>(2147483648.0f), kIntMax);
  EXPECT_EQ(convert<int32_t>(-2147483648.0f), kIntMin);
  EXPECT_EQ(convert<uint32_t>(-0.5f), 0u);
  EXPECT_EQ(convert<int64_t>(1e30), std::numeric_limits<int64_t>::max());
  EXPECT_EQ(convert<int64_t>(-1e30f), std::numeric_limits<int64_t>::min());
  EXPECT_EQ(convert<uint64_t>(1e30f), ~uint64_t{0});
  EXPECT_EQ(convert<int32_t>(2147483647.9), kIntMax);
  EXPECT_EQ(convert<int32_t>(half{0x7C00}), kIntMax);
  EXPECT_EQ(convert<int32_t>(half{0x7E00}), 0);
}

TEST(ShaderConvert, BetweenIntegersBoolsAndFloats) {
  EXPECT_EQ(convert<uint32_t>(-1), 0xFFFFFFFFu);
  EXPECT_EQ(convert<int16_t>(0x12348000), -32768);
  EXPECT_EQ(convert<int64_t>(-1), -1);
  EXPECT_EQ(convert<uint64_t>(0xFFFFFFFFu), 0xFFFFFFFFull);
  EXPECT_EQ(convert<float>(16777217), 16777216.0f);
  EXPECT_EQ(convert<float>(true), 1.0f);
  EXPECT_TRUE(convert<bool>(kNan));
  EXPECT_FALSE(convert<bool>(half{0x8000}));
  EXPECT_EQ(convert<half>(true).bits, 0x3C00);
  EXPECT_EQ(convert<half>(70000).bits, 0x7C00);
  EXPECT_EQ(convert<half>(0.5).bits, 0x3800);
  expect_components(convert<int32_t>(float3{1.9f, -1.9f, kNan}), {1, -1, 0});
  expect_components(convert<float>(uint2x2{1, 2, 3, 4}), {1, 2, 3, 4});
}

TEST(ShaderConvert, ChangesShapes) {
  expect_components(splat<float3>(2.0f), {2, 2, 2});
  expect_components(splat<float2x2>(2.0f), {2, 2, 2, 2});
  expect_components(truncate<float2>(float4{1, 2, 3, 4}), {1, 2});
  EXPECT_EQ(truncate<float>(float4{1, 2, 3, 4}), 1.0f);
  expect_components(truncate<float2x2>(float3x3{1, 2, 3, 4, 5, 6, 7, 8, 9}), {1, 2, 4, 5});
  expect_components(truncate<float3>(float1x4{1, 2, 3, 4}), {1, 2, 3});
  expect_components(make<float4>(1.0f, float2{2, 3}, 4.0f), {1, 2, 3, 4});
  expect_components(make<float2>(1.0f, 2.0f), {1, 2});
  expect_components(make<float3x3>(float3{1, 2, 3}, float3{4, 5, 6}, 7.0f, float2{8, 9}),
                    {1, 2, 3, 4, 5, 6, 7, 8, 9});
  expect_components(make<float4>(float2x2{1, 2, 3, 4}), {1, 2, 3, 4});
  const auto list = make<array<float2, 2>>(float2{1, 2}, float2{3, 4});
  expect_components(list[1], {3, 4});
}

TEST(ShaderConvert, SwizzlesReadAndAssign) {
  const float4 v{1, 2, 3, 4};
  expect_components(swizzle<2, 0, 0>(v), {3, 1, 1});
  EXPECT_EQ((swizzle<3>(v)), 4.0f);
  expect_components(swizzle<0, 0, 0>(7.0f), {7, 7, 7});
  float4 w = v;
  assign_swizzle<1, 0>(w, swizzle<0, 1>(w));
  expect_components(w, {2, 1, 3, 4});
  assign_swizzle<3>(w, 9.0f);
  expect_components(w, {2, 1, 3, 9});
  assign_swizzle<0, 1>(w, swizzle<1, 0>(w));
  expect_components(w, {1, 2, 3, 9});
  float s = 1;
  assign_swizzle<0>(s, 5.0f);
  EXPECT_EQ(s, 5.0f);

  float3x3 m{1, 2, 3, 4, 5, 6, 7, 8, 9};
  expect_components(matrix_swizzle<0, 5, 10>(m), {1, 5, 9});
  EXPECT_EQ((matrix_swizzle<6>(m)), 6.0f);
  assign_matrix_swizzle<1, 4>(m, float2{20, 40});
  expect_components(m, {1, 20, 3, 40, 5, 6, 7, 8, 9});
}

TEST(ShaderConvert, SubscriptsOutOfRangeReadZeroAndWriteNothing) {
  float3 v{1, 2, 3};
  float3x2 m{1, 2, 3, 4, 5, 6};
  array<int, 3> a{1, 2, 3};
  EXPECT_EQ(element(v, 2), 3.0f);
  expect_components(element(m, 1u), {3, 4});
  EXPECT_EQ(element(a, 0), 1);
  for (const int32_t i : {3, 4, -1, kIntMin, kIntMax}) {
    EXPECT_EQ(element(v, i), 0.0f) << i;
    EXPECT_EQ(element(v, static_cast<uint32_t>(i)), 0.0f) << i;
    expect_components(element(m, i), {0, 0});
    EXPECT_EQ(element(a, i), 0);
    assign_element(v, i, 9.0f);
    element_ref(v, i) = 9.0f;
    element_ref(m, i)[1] = 9.0f;
    element_ref(element_ref(m, 1), i) = 9.0f;
    element_ref(element_ref(m, i), 1) = 9.0f;
    assign_element(a, i, 9);
  }
  expect_components(v, {1, 2, 3});
  expect_components(m, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(a[0] + a[1] + a[2], 6);
  element_ref(element_ref(m, 2), 0) = 50.0f;
  assign_element(v, 1u, 20.0f);
  expect_components(m, {1, 2, 3, 4, 50, 6});
  expect_components(v, {1, 20, 3});
}

}  // namespace
}  // namespace kaamos::shader
