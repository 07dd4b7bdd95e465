// SPDX-License-Identifier: MIT
#include "kaamos/shader/intrinsics_scalar.h"

#include "runtime/shader/float_mode.h"
#include "runtime/shader/test_values.h"

namespace kaamos::shader {
namespace {

struct UnaryCase {
  const char* name;
  float (*function)(float);
  long double (*reference)(long double);
  int ulps;
};

// D3D requires far less (2^-11 absolute for sin); these bounds hold libm and our formulas to what
// they promise.
const UnaryCase kUnary[] = {
    {"acos", [](float x) { return acos(x); }, std::acos, 2},
    {"asin", [](float x) { return asin(x); }, std::asin, 2},
    {"atan", [](float x) { return atan(x); }, std::atan, 2},
    {"ceil", [](float x) { return ceil(x); }, std::ceil, 0},
    {"cos", [](float x) { return cos(x); }, std::cos, 2},
    {"cosh", [](float x) { return cosh(x); }, std::cosh, 2},
    {"exp", [](float x) { return exp(x); }, std::exp, 2},
    {"exp2", [](float x) { return exp2(x); }, std::exp2, 2},
    {"floor", [](float x) { return floor(x); }, std::floor, 0},
    {"log", [](float x) { return log(x); }, std::log, 2},
    {"log10", [](float x) { return log10(x); }, std::log10, 2},
    {"log2", [](float x) { return log2(x); }, std::log2, 2},
    {"rcp", [](float x) { return rcp(x); }, [](long double x) { return 1 / x; }, 1},
    {"round", [](float x) { return round(x); }, std::nearbyint, 0},
    {"rsqrt", [](float x) { return rsqrt(x); }, [](long double x) { return 1 / std::sqrt(x); }, 2},
    {"sin", [](float x) { return sin(x); }, std::sin, 2},
    {"sinh", [](float x) { return sinh(x); }, std::sinh, 2},
    {"sqrt", [](float x) { return sqrt(x); }, std::sqrt, 1},
    {"tan", [](float x) { return tan(x); }, std::tan, 2},
    {"tanh", [](float x) { return tanh(x); }, std::tanh, 2},
    {"trunc", [](float x) { return trunc(x); }, std::trunc, 0},
    {"radians", [](float x) { return radians(x); },
     [](long double x) { return x * 0.0174532925199432957692L; }, 1},
    {"degrees", [](float x) { return degrees(x); },
     [](long double x) { return x * 57.2957795130823208768L; }, 1},
};

// Intrinsics take denormals for zero of the same sign.
float flushed(float x) {
  const auto bits = std::bit_cast<uint32_t>(x);
  return (bits & 0x7F800000u) == 0 ? std::bit_cast<float>(bits & 0x80000000u) : x;
}

template <class Function>
float in_shader(Function function) {
  const FloatMode mode;
  return function();
}

// A result that is a denormal is zero as well.
long double flushed(long double x) {
  return std::abs(x) < 0x1p-126L ? std::copysign(0.0L, x) : x;
}

TEST(ShaderScalarIntrinsics, AgreeWithLongDouble) {
  for (const UnaryCase& c : kUnary) {
    for (const float x : kFloats) {
      expect_near_ulps(in_shader([&] { return c.function(x); }),
                       flushed(c.reference(static_cast<long double>(flushed(x)))), c.ulps, c.name,
                       static_cast<double>(x));
    }
    for (int i = -400; i <= 400; ++i) {
      const float x = static_cast<float>(i) * 0.0371f;
      expect_near_ulps(c.function(x), c.reference(static_cast<long double>(x)), c.ulps, c.name,
                       static_cast<double>(x));
    }
  }
}

void expect_waves(float x) {
  expect_near_ulps(sin(x), std::sin(static_cast<long double>(x)), 2, "sin", static_cast<double>(x));
  expect_near_ulps(cos(x), std::cos(static_cast<long double>(x)), 2, "cos", static_cast<double>(x));
  expect_same(sin(-x), -sin(x), "sin of the opposite", static_cast<double>(x));
  expect_same(cos(-x), cos(x), "cos of the opposite", static_cast<double>(x));
}

TEST(ShaderScalarIntrinsics, SineAndCosineKeepTheirDigitsBesideTheirZeros) {
  // About 2,000 floats of each octave, and those around every multiple of pi / 2.
  const auto last = std::bit_cast<uint32_t>(op::kLargestAngle);
  for (uint32_t bits = std::bit_cast<uint32_t>(0x1p-30f); bits <= last; bits += 4099) {
    expect_waves(std::bit_cast<float>(bits));
  }
  for (int i = 1; i <= 325; ++i) {
    const auto nearest = static_cast<float>(i * 1.57079632679489661923L);
    for (int k = -3; k <= 3; ++k) {
      expect_waves(
          std::bit_cast<float>(std::bit_cast<uint32_t>(nearest) + static_cast<uint32_t>(k)));
    }
  }
}

TEST(ShaderScalarIntrinsics, SineAndCosineOfWhatIsLargeAreLibms) {
  for (const float x : {std::nextafter(op::kLargestAngle, kInf), 1234.5f, 1e6f, 1e30f, kMaxFloat}) {
    expect_same(sin(x), std::sin(x), "sin", static_cast<double>(x));
    expect_same(cos(-x), std::cos(x), "cos", static_cast<double>(x));
  }
}

TEST(ShaderScalarIntrinsics, RoundGoesToEven) {
  expect_same(round(0.5f), 0.0f, "round");
  expect_same(round(1.5f), 2.0f, "round");
  expect_same(round(2.5f), 2.0f, "round");
  expect_same(round(-0.5f), -0.0f, "round");
  expect_same(round(-2.5f), -2.0f, "round");
  expect_same(round(8388609.0f), 8388609.0f, "round");
}

TEST(ShaderScalarIntrinsics, MinMaxReturnTheOperandThatIsANumber) {
  expect_same(min(kNan, 1.0f), 1.0f, "min");
  expect_same(min(1.0f, kNan), 1.0f, "min");
  expect_same(max(kNan, -1.0f), -1.0f, "max");
  expect_same(max(-1.0f, kNan), -1.0f, "max");
  expect_same(max(kNan, kNan), kNan, "max");
  for (const float a : kFloats) {
    for (const float b : kFloats) {
      if (std::isnan(a) || std::isnan(b) || a == b) continue;
      expect_same(min(a, b), std::fmin(a, b), "min");
      expect_same(max(a, b), std::fmax(a, b), "max");
    }
  }
  EXPECT_EQ(min(kIntMin, 3), kIntMin);
  EXPECT_EQ(max(0xFFFFFFFFu, 3u), 0xFFFFFFFFu);
  EXPECT_EQ(to_float(min(half{0x7E00}, to_half(2.0f))), 2.0f);
  expect_components(max(float2{1, kNan}, float2{kNan, 4}), {1, 4});
}

TEST(ShaderScalarIntrinsics, SaturateAndClampTurnNanIntoTheLowEnd) {
  expect_same(saturate(kNan), 0.0f, "saturate");
  expect_same(saturate(-0.5f), 0.0f, "saturate");
  expect_same(saturate(kInf), 1.0f, "saturate");
  expect_same(saturate(0.25f), 0.25f, "saturate");
  expect_same(saturate(-kInf), 0.0f, "saturate");
  EXPECT_EQ(saturate(half{0x7E00}).bits, 0);
  expect_same(clamp(kNan, 2.0f, 3.0f), 2.0f, "clamp");
  expect_same(clamp(5.0f, 2.0f, 3.0f), 3.0f, "clamp");
  EXPECT_EQ(clamp(-5, -2, 3), -2);
  EXPECT_EQ(clamp(5u, 2u, 3u), 3u);
  EXPECT_EQ(clamp(5.0, 2.0, 3.0), 3.0);
}

TEST(ShaderScalarIntrinsics, SignIsAnInteger) {
  static_assert(std::is_same_v<decltype(sign(1.0f)), int32_t>);
  static_assert(std::is_same_v<decltype(sign(float3{})), int3>);
  for (const float x : kFloats) EXPECT_EQ(sign(x), x > 0 ? 1 : x < 0 ? -1 : 0) << x;
  EXPECT_EQ(sign(kIntMin), -1);
  EXPECT_EQ(sign(half{0xBC00}), -1);
}

TEST(ShaderScalarIntrinsics, AbsKeepsWhatHasNoOpposite) {
  EXPECT_EQ(abs(kIntMin), kIntMin);
  EXPECT_EQ(abs(-5), 5);
  EXPECT_EQ(abs(0x80000000u), 0x80000000u);
  expect_same(abs(-0.0f), 0.0f, "abs");
  expect_same(abs(-kInf), kInf, "abs");
  EXPECT_EQ(abs(half{0xFC00}).bits, 0x7C00);
}

TEST(ShaderScalarIntrinsics, FracStaysBelowOne) {
  expect_same(frac(1.25f), 0.25f, "frac");
  expect_same(frac(-1.25f), 0.75f, "frac");
  expect_same(frac(-1e-10f), 0x1.fffffep-1f, "frac");
  expect_same(frac(kInf), kNan, "frac");
  expect_same(frac(kNan), kNan, "frac");
  expect_same(frac(kMaxFloat), 0.0f, "frac");
}

TEST(ShaderScalarIntrinsics, PowIsExp2OfLog2) {
  expect_same(pow(2.0f, 10.0f), 1024.0f, "pow");
  expect_same(pow(-2.0f, 2.0f), kNan, "pow");
  expect_same(pow(0.0f, 2.0f), 0.0f, "pow");
  expect_same(pow(0.0f, -2.0f), kInf, "pow");
  expect_same(pow(-0.0f, -1.0f), kInf, "pow");
  expect_same(pow(kNan, 0.0f), kNan, "pow");
  expect_same(pow(1.0f, kNan), kNan, "pow");
  expect_same(pow(kInf, 0.5f), kInf, "pow");
  // exp2(y * log2(x)) with a product of 0 and an infinity.
  expect_same(pow(0.0f, 0.0f), kNan, "pow");
  expect_same(pow(kInf, -0.0f), kNan, "pow");
  expect_same(pow(1.0f, -kInf), kNan, "pow");
  expect_same(pow(2.0f, 0.0f), 1.0f, "pow");
  expect_same(pow(1.0f, 5.0f), 1.0f, "pow");
  for (int i = 1; i < 100; ++i) {
    for (int j = -20; j < 20; ++j) {
      const float x = static_cast<float>(i) * 0.173f, y = static_cast<float>(j) * 0.77f;
      expect_near_ulps(pow(x, y),
                       std::pow(static_cast<long double>(x), static_cast<long double>(y)), 2, "pow",
                       static_cast<double>(x), static_cast<double>(y));
    }
  }
}

TEST(ShaderScalarIntrinsics, TwoArgumentsAgreeWithLongDouble) {
  for (const float a : kFloats) {
    for (const float b : kFloats) {
      const long double x = static_cast<long double>(flushed(a));
      const long double y = static_cast<long double>(flushed(b));
      if (y != 0 && !(x == 0 && y < 0)) {  // zeros: below
        expect_near_ulps(in_shader([&] { return atan2(a, b); }), flushed(std::atan2(x, y)), 2,
                         "atan2", static_cast<double>(a), static_cast<double>(b));
      }
      expect_near_ulps(in_shader([&] { return fmod(a, b); }), flushed(std::fmod(x, y)), 0, "fmod",
                       static_cast<double>(a), static_cast<double>(b));
      if (a != flushed(a) || b != flushed(b)) continue;
      expect_same(step(a, b), b < a ? 0.0f : 1.0f, "step");
    }
  }
}

// The whole table of DXC's expansion where an argument is zero.
TEST(ShaderScalarIntrinsics, Atan2OfZeros) {
  constexpr float kPi = 3.14159274f, kHalfPi = 1.57079637f;
  for (const float zero : {0.0f, -0.0f}) {
    for (const float other : {0.0f, -0.0f, 1.0f, kInf, 0x1p-140f}) {
      expect_same(in_shader([&] { return atan2(other, zero); }), kHalfPi, "atan2");
    }
    for (const float other : {-1.0f, -kInf}) {
      expect_same(in_shader([&] { return atan2(other, zero); }), -kHalfPi, "atan2");
      expect_same(in_shader([&] { return atan2(zero, other); }), kPi, "atan2");
    }
    expect_same(in_shader([&] { return atan2(zero, 1.0f); }), zero, "atan2");
    expect_same(in_shader([&] { return atan2(zero, kNan); }), kNan, "atan2");
    expect_same(in_shader([&] { return atan2(kNan, zero); }), kNan, "atan2");
    EXPECT_EQ(atan2(double{zero}, -1.0), 3.141592653589793);
    EXPECT_EQ(atan2(-1.0, double{zero}), -1.5707963267948966);
  }
}

TEST(ShaderScalarIntrinsics, LdexpFrexpModf) {
  expect_same(ldexp(0.5f, 128.0f), 0x1p127f, "ldexp");
  expect_same(ldexp(3.0f, -1.0f), 1.5f, "ldexp");
  expect_same(ldexp(1.0f, -126.0f), 0x1p-126f, "ldexp");
  expect_same(ldexp(1.0f, -149.0f), 0.0f, "ldexp");
  expect_same(ldexp(1.0f, 500.0f), kInf, "ldexp");
  expect_near_ulps(ldexp(3.0f, 0.5f), 3 * std::sqrt(2.0L), 2, "ldexp");
  expect_same(ldexp(1.0f, kNan), kNan, "ldexp");
  for (const float given : kFloats) {
    const float x = flushed(given);
    const float m = frexp_mantissa(given), e = frexp_exponent(given);
    if (std::isfinite(x) && x != 0.0f) {
      EXPECT_GE(std::abs(m), 0.5f);
      EXPECT_LT(std::abs(m), 1.0f);
      expect_same(ldexp(m, e), std::abs(x), "frexp", static_cast<double>(x));
      expect_same(modf_integer(given), std::trunc(x), "modf");
      expect_same(modf_fraction(given), x - std::trunc(x), "modf");
    } else if (x == 0.0f) {
      expect_same(m, 0.0f, "frexp", static_cast<double>(x));
      expect_same(e, 0.0f, "frexp", static_cast<double>(x));
    } else {
      if (std::isinf(x)) expect_same(m, 0.5f, "frexp", static_cast<double>(x));
      expect_same(e, 129.0f, "frexp", static_cast<double>(x));
    }
  }
  expect_components(modf_fraction(float2{2.75f, -2.75f}), {0.75, -0.75});
  EXPECT_EQ(modf_fraction(5), 0);
}

TEST(ShaderScalarIntrinsics, MadRoundsTwiceFmaOnce) {
  const float x = 1.0f + 0x1p-12f;
  expect_same(mad(x, x, -1.0f), x * x - 1.0f, "mad");
  expect_same(fma(x, x, -1.0f), 0x1p-11f + 0x1p-24f, "fma");
  EXPECT_NE(mad(x, x, -1.0f), fma(x, x, -1.0f));
  EXPECT_EQ(mad(kIntMax, 2, 3), 1);
  EXPECT_EQ(fma(3.0, 4.0, 5.0), 17.0);
}

TEST(ShaderScalarIntrinsics, Interpolation) {
  expect_same(lerp(2.0f, 4.0f, 0.25f), 2.5f, "lerp");
  expect_components(lerp(float2{0, 10}, float2{1, 20}, float2{0.5f, 2}), {0.5, 30});
  expect_same(smoothstep(0.0f, 2.0f, 1.0f), 0.5f, "smoothstep");
  expect_same(smoothstep(0.0f, 2.0f, 9.0f), 1.0f, "smoothstep");
  expect_same(smoothstep(0.0f, 2.0f, kNan), 0.0f, "smoothstep");
  EXPECT_EQ(to_float(lerp(to_half(0.0f), to_half(1.0f), to_half(0.5f))), 0.5f);
}

}  // namespace
}  // namespace kaamos::shader
