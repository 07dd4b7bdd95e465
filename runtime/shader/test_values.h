// SPDX-License-Identifier: MIT
//
// For tests: values that arithmetic often gets wrong, and comparisons that distinguish NaNs and
// zeros.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "kaamos/shader/vector.h"

namespace kaamos::shader {

inline constexpr float kInf = std::numeric_limits<float>::infinity();
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kDenormal = 1e-40f;
inline constexpr float kMaxFloat = std::numeric_limits<float>::max();
inline constexpr int32_t kIntMin = std::numeric_limits<int32_t>::min();
inline constexpr int32_t kIntMax = std::numeric_limits<int32_t>::max();

inline constexpr float kFloats[] = {
    0.0f,  -0.0f,     1.0f,       -1.0f, 0.5f,   -0.5f,     1.5f,       2.5f, -2.5f,
    3.75f, 1e-3f,     -7.25f,     1e10f, -1e10f, kMaxFloat, -kMaxFloat, kInf, -kInf,
    kNan,  kDenormal, -kDenormal, 1e-8f, -1e-8f, 123.456f,  -65504.0f};
inline constexpr int32_t kInts[] = {0,  1,  -1, 2,  -2, 7,       -7,      31,
                                    32, 33, 63, 64, 65, kIntMin, kIntMax, 0x12345678};

// Expects the same bits, except that any NaN equals any other.
inline void expect_same(float actual, float expected, const char* what, double a = 0,
                        double b = 0) {
  if (std::isnan(expected) && std::isnan(actual)) return;
  EXPECT_EQ(std::bit_cast<uint32_t>(actual), std::bit_cast<uint32_t>(expected))
      << what << "(" << a << ", " << b << ") is " << actual << ", not " << expected;
}

// Expects a result within `ulps` of the reference rounded to float.
inline void expect_near_ulps(float actual, long double reference, int ulps, const char* what,
                             double a = 0, double b = 0) {
  const float expected = static_cast<float>(reference);
  if (std::isnan(expected) || std::isinf(expected)) {
    if (std::isinf(expected) && std::abs(actual) >= kMaxFloat) return;
    expect_same(actual, expected, what, a, b);
    return;
  }
  const float magnitude = std::max(std::abs(expected), std::numeric_limits<float>::denorm_min());
  const float step = magnitude - std::nextafter(magnitude, 0.0f);
  EXPECT_LE(std::abs(static_cast<double>(actual) - static_cast<double>(reference)),
            ulps * static_cast<double>(step))
      << what << "(" << a << ", " << b << ") is " << actual << ", not " << expected;
}

template <class V>
void expect_components(const V& actual, std::initializer_list<double> expected) {
  ASSERT_EQ(static_cast<size_t>(shape<V>::count), expected.size());
  int i = 0;
  for (const double value : expected) {
    const auto c = component(actual, i);
    if constexpr (is_half<scalar_of<V>>) {
      EXPECT_EQ(static_cast<double>(to_float(c)), value) << "component " << i;
    } else {
      EXPECT_EQ(static_cast<double>(c), value) << "component " << i;
    }
    ++i;
  }
}

}  // namespace kaamos::shader
