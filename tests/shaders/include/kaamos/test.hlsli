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

// What the lines "#pragma kaamos geometry", "gltf" and "instance" describe.
RaytracingAccelerationStructure TestScene : register(t0, space9999);

// The first record of a hit group, a miss or a callable shader of this file in its table.
// MISS(none) runs nothing.
#define HIT_GROUP(name) KAAMOS_HIT_GROUP_##name
#define MISS(name) KAAMOS_MISS_##name
#define CALLABLE(name) KAAMOS_CALLABLE_##name

// A triangle of (0,0,0), (0,1,0) and (1,0,0), and a box from -1 to 1.
RaytracingAccelerationStructure kaamos_TestTriangle : register(t1, space9999);
RaytracingAccelerationStructure kaamos_TestBox : register(t2, space9999);

namespace kaamos_test {
// Rays name hit groups with 4 bits.
void CheckHitGroup(uint hit_group) {
  if (hit_group > 15) errorf("hit group %u is called alone, and only 0 to 15 can be", hit_group);
}
}  // namespace kaamos_test

// Runs a hit group of triangles alone: its any-hit shader at these barycentrics, unless flags make
// the triangle opaque, and its closest-hit shader if the hit is not ignored. RayTCurrent() is 1, the
// front is hit. Hit groups have the numbers 0 to 15; others fail. For tests in "raygeneration".
template <typename Payload>
void CallHitGroup(uint hit_group, float2 barycentrics, inout Payload payload,
                  uint flags = RAY_FLAG_NONE) {
  kaamos_test::CheckHitGroup(hit_group);
  const RayDesc ray = {float3(barycentrics.yx, -1), 0, float3(0, 0, 1), 2};
  TraceRay(kaamos_TestTriangle, flags, 0xFF, hit_group, 0, MISS(none), ray, payload);
}
// The same of a hit group with an intersection shader, which gets a ray that meets the box.
template <typename Payload>
void CallProceduralHitGroup(uint hit_group, RayDesc ray, inout Payload payload,
                            uint flags = RAY_FLAG_NONE) {
  kaamos_test::CheckHitGroup(hit_group);
  TraceRay(kaamos_TestBox, flags, 0xFF, hit_group, 0, MISS(none), ray, payload);
}
// Runs a miss shader alone.
template <typename Payload>
void CallMiss(uint miss, RayDesc ray, inout Payload payload) {
  TraceRay(kaamos_TestTriangle, RAY_FLAG_NONE, 0, 0, 0, miss, ray, payload);
}

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
