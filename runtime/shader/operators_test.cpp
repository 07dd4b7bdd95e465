// SPDX-License-Identifier: MIT
#include "kaamos/shader/operators.h"

#include "runtime/shader/test_values.h"

namespace kaamos::shader {
namespace {

TEST(ShaderOperators, IntegersWrap) {
  for (const int32_t a : kInts) {
    for (const int32_t b : kInts) {
      const int64_t x = a, y = b;
      EXPECT_EQ(add(a, b), static_cast<int32_t>(x + y));
      EXPECT_EQ(sub(a, b), static_cast<int32_t>(x - y));
      EXPECT_EQ(mul_c(a, b), static_cast<int32_t>(x * y));
      EXPECT_EQ(mul_c(static_cast<uint32_t>(a), static_cast<uint32_t>(b)),
                static_cast<uint32_t>(x * y));
    }
    EXPECT_EQ(negate(a), static_cast<int32_t>(-int64_t{a}));
  }
  EXPECT_EQ(mul_c(uint16_t{65535}, uint16_t{65535}), 1);
  EXPECT_EQ(add(int16_t{32767}, int16_t{1}), -32768);
  EXPECT_EQ(mul_c(std::numeric_limits<int64_t>::min(), int64_t{-1}),
            std::numeric_limits<int64_t>::min());
  EXPECT_EQ(negate(uint32_t{1}), 0xFFFFFFFFu);
}

TEST(ShaderOperators, IntegerDivisionNeverTraps) {
  EXPECT_EQ(div(7u, 0u), 0xFFFFFFFFu);
  EXPECT_EQ(mod(7u, 0u), 0xFFFFFFFFu);
  EXPECT_EQ(div(7, 0), -1);
  EXPECT_EQ(mod(7, 0), -1);
  EXPECT_EQ(div(kIntMin, -1), kIntMin);
  EXPECT_EQ(mod(kIntMin, -1), 0);
  EXPECT_EQ(div(std::numeric_limits<int64_t>::min(), int64_t{-1}),
            std::numeric_limits<int64_t>::min());
  EXPECT_EQ(div(int16_t{-32768}, int16_t{-1}), -32768);
  EXPECT_EQ(div(uint64_t{5}, uint64_t{0}), ~uint64_t{0});
  for (const int32_t a : kInts) {
    for (const int32_t b : kInts) {
      if (b == 0 || (a == kIntMin && b == -1)) continue;
      EXPECT_EQ(div(a, b), a / b);
      EXPECT_EQ(mod(a, b), a % b);
    }
  }
}

TEST(ShaderOperators, FloatRemainderHasTheDividendsSign) {
  expect_same(mod(5.5f, 2.0f), 1.5f, "mod");
  expect_same(mod(-5.5f, 2.0f), -1.5f, "mod");
  expect_same(mod(5.5f, -2.0f), 1.5f, "mod");
  expect_same(mod(1.0f, 0.0f), kNan, "mod");
  expect_same(mod(kInf, 2.0f), kNan, "mod");
  expect_same(mod(3.0f, kInf), 3.0f, "mod");
  EXPECT_EQ(mod(-7.5, 2.0), -1.5);
}

TEST(ShaderOperators, ShiftsMaskTheirCount) {
  for (const int32_t a : kInts) {
    for (const int32_t n : kInts) {
      const uint32_t count = static_cast<uint32_t>(n) & 31u;
      EXPECT_EQ(shl(a, n), static_cast<int32_t>(static_cast<uint32_t>(a) << count)) << a << n;
      EXPECT_EQ(shr(a, n), a >> count) << a << n;
      EXPECT_EQ(shr(static_cast<uint32_t>(a), static_cast<uint32_t>(n)),
                static_cast<uint32_t>(a) >> count);
    }
  }
  EXPECT_EQ(shl(1u, 32u), 1u);
  EXPECT_EQ(shl(int64_t{1}, int64_t{65}), 2);
  EXPECT_EQ(shl(uint16_t{1}, uint16_t{17}), 2);
  EXPECT_EQ(shr(int16_t{-4}, int16_t{17}), -2);
  EXPECT_EQ(shr(-1, 31), -1);
}

TEST(ShaderOperators, BitOperatorsActOnBoolsToo) {
  EXPECT_EQ(bit_and(0xFF00u, 0x0FF0u), 0x0F00u);
  EXPECT_EQ(bit_or(0xFF00u, 0x0FF0u), 0xFFF0u);
  EXPECT_EQ(bit_xor(0xFF00u, 0x0FF0u), 0xF0F0u);
  EXPECT_EQ(bit_not(0u), 0xFFFFFFFFu);
  EXPECT_EQ(bit_not(int16_t{0}), -1);
  EXPECT_TRUE(bit_or(true, false));
  EXPECT_FALSE(bit_and(true, false));
  EXPECT_FALSE(bit_not(true));
  expect_components(bit_xor(bool3{true, true, false}, bool3{true, false, false}), {0, 1, 0});
}

TEST(ShaderOperators, ComparisonsWithNanAreFalseExceptNotEqual) {
  for (const float a : kFloats) {
    for (const float b : kFloats) {
      EXPECT_EQ(less(a, b), a < b);
      EXPECT_EQ(less_equal(a, b), a <= b);
      EXPECT_EQ(greater(a, b), a > b);
      EXPECT_EQ(greater_equal(a, b), a >= b);
      EXPECT_EQ(equal(a, b), a == b);
      EXPECT_EQ(not_equal(a, b), a != b);
    }
  }
  EXPECT_TRUE(equal(half{0x8000}, half{0x0000}));
  EXPECT_FALSE(equal(half{0x7E00}, half{0x7E00}));
  expect_components(less(float3{1, 2, kNan}, float3{2, 2, 2}), {1, 0, 0});
  expect_components(greater_equal(int2x2{1, 2, 3, 4}, int2x2{2, 2, 2, 2}), {0, 1, 1, 1});
}

TEST(ShaderOperators, VectorsAndMatricesGoComponentByComponent) {
  expect_components(add(float4{1, 2, 3, 4}, float4{10, 20, 30, 40}), {11, 22, 33, 44});
  expect_components(sub(float1{1}, float1{3}), {-2});
  expect_components(mul_c(float2x3{1, 2, 3, 4, 5, 6}, float2x3{2, 2, 2, 3, 3, 3}),
                    {2, 4, 6, 12, 15, 18});
  expect_components(div(float4x4{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16},
                        float4x4{1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2}),
                    {1, 1, 3, 2, 5, 3, 7, 4, 9, 5, 11, 6, 13, 7, 15, 8});
  expect_components(div(uint3{9, 9, 9}, uint3{3, 0, 2}), {3, 4294967295.0, 4});
  expect_components(negate(float3{1, -2, 0}), {-1, 2, 0});
  expect_components(logical_not(float3{1, 0, kNan}), {0, 1, 0});
  expect_components(logical_not(int3x1{0, 5, 0}), {1, 0, 1});
}

TEST(ShaderOperators, HalfArithmeticRoundsOnce) {
  const auto h = [](float x) { return to_half(x); };
  EXPECT_EQ(to_float(add(h(2048), h(1))), 2048.0f);  // a tie, to even
  EXPECT_EQ(to_float(add(h(2048), h(3))), 2052.0f);
  EXPECT_EQ(to_float(mul_c(h(300), h(300))), kInf);
  EXPECT_EQ(to_float(div(h(1), h(3))), to_float(h(1.0f / 3.0f)));
  EXPECT_EQ(to_float(sub(h(1), h(1))), 0.0f);
  EXPECT_EQ(negate(h(0)).bits, 0x8000);
  EXPECT_EQ(to_float(mod(h(-5.5f), h(2))), -1.5f);
}

TEST(ShaderOperators, SelectTakesBoolOrBoolVector) {
  expect_components(select(bool3{true, false, true}, float3{1, 2, 3}, float3{4, 5, 6}), {1, 5, 3});
  expect_components(select(false, float3{1, 2, 3}, float3{4, 5, 6}), {4, 5, 6});
  expect_components(
      select(bool2x2{true, false, false, true}, int2x2{1, 2, 3, 4}, int2x2{5, 6, 7, 8}),
      {1, 6, 7, 4});
  EXPECT_EQ(select(true, array<int, 2>{1, 2}, array<int, 2>{3, 4})[1], 2);
}

}  // namespace
}  // namespace kaamos::shader
