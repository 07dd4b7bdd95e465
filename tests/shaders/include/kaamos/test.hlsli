// SPDX-License-Identifier: MIT
//
// What tests of shaders include; kaamos-test runs them. [test] marks a function as a test:
//
//   #include <kaamos/test.hlsli>
//   [test] void LengthOfAUnitVector() { EXPECT_NEAR(length(float3(0, 1, 0)), 1, 1e-6); }
//
// Arguments may be scalars, vectors and matrices, which are compared by component. EXPECT_ goes on
// after a failure; ASSERT_ returns from the test, and so belongs into the test itself.
#pragma once

// What the lines "#pragma kaamos geometry" and "#pragma kaamos instance" describe.
RaytracingAccelerationStructure TestScene : register(t0, space9999);

namespace kaamos_test {

// Each remembers the values for the report unless it is true.
template <typename A, typename B>
bool Equal(A actual, B expected) {
  if (all(actual == expected)) return true;
  printf("[values] actual %v, expected %v", actual, expected);
  return false;
}
template <typename A, typename B>
bool NotEqual(A actual, B other) {
  if (any(actual != other)) return true;
  printf("[values] both %v", actual);
  return false;
}
template <typename A, typename B>
bool Less(A actual, B limit) {
  if (all(actual < limit)) return true;
  printf("[values] actual %v, limit %v", actual, limit);
  return false;
}
template <typename A, typename B>
bool LessOrEqual(A actual, B limit) {
  if (all(actual <= limit)) return true;
  printf("[values] actual %v, limit %v", actual, limit);
  return false;
}
template <typename A, typename B, typename T>
bool Near(A actual, B expected, T tolerance) {
  // Infinities are near themselves, NaN is near nothing.
  if (all(actual == expected)) return true;
  if (all(abs(actual - expected) <= tolerance)) return true;
  printf("[values] actual %v, expected %v, tolerance %v", actual, expected, tolerance);
  return false;
}
template <typename A>
bool True(A actual) {
  if (all(actual)) return true;
  printf("[values] actual %v", actual);
  return false;
}
template <typename A>
bool False(A actual) {
  if (!any(actual)) return true;
  printf("[values] actual %v", actual);
  return false;
}
template <typename A>
bool Nan(A actual) {
  if (all(isnan(actual))) return true;
  printf("[values] actual %v", actual);
  return false;
}

// Floats as integers that ascend with them.
int Steps(float value) {
  const int bits = asint(value);
  return bits < 0 ? int(0x80000000u) - bits : bits;
}
bool NearBySteps(float actual, float expected, uint steps) {
  const bool near = !isnan(actual) && !isnan(expected) &&
                    uint(abs(Steps(actual) - Steps(expected))) <= steps;
  if (near) return true;
  printf("[values] actual %v, expected %v, %v steps of floats apart", actual, expected,
         abs(Steps(actual) - Steps(expected)));
  return false;
}

}  // namespace kaamos_test

#define KAAMOS_CHECK(holds, name, text)                               \
  do {                                                                \
    if (!(holds)) errorf("%s:%u: %s(%s)", __FILE__, __LINE__, name, text); \
  } while (false)
#define KAAMOS_REQUIRE(holds, name, text)                       \
  do {                                                          \
    if (!(holds)) {                                             \
      errorf("%s:%u: %s(%s)", __FILE__, __LINE__, name, text);  \
      return;                                                   \
    }                                                           \
  } while (false)

#define EXPECT_EQ(actual, expected) \
  KAAMOS_CHECK(kaamos_test::Equal(actual, expected), "EXPECT_EQ", #actual ", " #expected)
#define EXPECT_NE(actual, other) \
  KAAMOS_CHECK(kaamos_test::NotEqual(actual, other), "EXPECT_NE", #actual ", " #other)
#define EXPECT_LT(actual, limit) \
  KAAMOS_CHECK(kaamos_test::Less(actual, limit), "EXPECT_LT", #actual ", " #limit)
#define EXPECT_LE(actual, limit) \
  KAAMOS_CHECK(kaamos_test::LessOrEqual(actual, limit), "EXPECT_LE", #actual ", " #limit)
#define EXPECT_NEAR(actual, expected, tolerance)                                  \
  KAAMOS_CHECK(kaamos_test::Near(actual, expected, tolerance), "EXPECT_NEAR",     \
               #actual ", " #expected ", " #tolerance)
// At most so many representable floats apart.
#define EXPECT_NEAR_ULP(actual, expected, steps)                                        \
  KAAMOS_CHECK(kaamos_test::NearBySteps(actual, expected, steps), "EXPECT_NEAR_ULP",    \
               #actual ", " #expected ", " #steps)
#define EXPECT_TRUE(actual) KAAMOS_CHECK(kaamos_test::True(actual), "EXPECT_TRUE", #actual)
#define EXPECT_FALSE(actual) KAAMOS_CHECK(kaamos_test::False(actual), "EXPECT_FALSE", #actual)
#define EXPECT_NAN(actual) KAAMOS_CHECK(kaamos_test::Nan(actual), "EXPECT_NAN", #actual)

#define ASSERT_EQ(actual, expected) \
  KAAMOS_REQUIRE(kaamos_test::Equal(actual, expected), "ASSERT_EQ", #actual ", " #expected)
#define ASSERT_NE(actual, other) \
  KAAMOS_REQUIRE(kaamos_test::NotEqual(actual, other), "ASSERT_NE", #actual ", " #other)
#define ASSERT_LT(actual, limit) \
  KAAMOS_REQUIRE(kaamos_test::Less(actual, limit), "ASSERT_LT", #actual ", " #limit)
#define ASSERT_LE(actual, limit) \
  KAAMOS_REQUIRE(kaamos_test::LessOrEqual(actual, limit), "ASSERT_LE", #actual ", " #limit)
#define ASSERT_NEAR(actual, expected, tolerance)                                  \
  KAAMOS_REQUIRE(kaamos_test::Near(actual, expected, tolerance), "ASSERT_NEAR",   \
                 #actual ", " #expected ", " #tolerance)
#define ASSERT_TRUE(actual) KAAMOS_REQUIRE(kaamos_test::True(actual), "ASSERT_TRUE", #actual)
#define ASSERT_FALSE(actual) KAAMOS_REQUIRE(kaamos_test::False(actual), "ASSERT_FALSE", #actual)
#define ASSERT_NAN(actual) KAAMOS_REQUIRE(kaamos_test::Nan(actual), "ASSERT_NAN", #actual)

// Fails, and goes on.
#define ADD_FAILURE(text) errorf("%s:%u: %s", __FILE__, __LINE__, text)
// Ends the test, which counts as skipped.
#define SKIP(reason)               \
  do {                             \
    printf("[skipped] %s", reason); \
    return;                        \
  } while (false)
