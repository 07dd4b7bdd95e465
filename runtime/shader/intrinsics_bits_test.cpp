// SPDX-License-Identifier: MIT
#include "kaamos/shader/intrinsics_bits.h"

#include "runtime/shader/test_values.h"

namespace kaamos::shader {
namespace {

TEST(ShaderBitIntrinsics, CountAndFind) {
  struct Case {
    uint32_t x;
    uint32_t count, low, high, reversed;
  };
  const Case cases[] = {
      {0, 0, ~0u, ~0u, 0},
      {1, 1, 0, 0, 0x80000000u},
      {0x80000000u, 1, 31, 31, 1},
      {0xFFFFFFFFu, 32, 0, 31, 0xFFFFFFFFu},
      {0x00010100u, 2, 8, 16, 0x00808000u},
      {0x12345678u, 13, 3, 28, 0x1E6A2C48u},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(countbits(c.x), c.count) << c.x;
    EXPECT_EQ(firstbitlow(c.x), c.low) << c.x;
    EXPECT_EQ(firstbithigh(c.x), c.high) << c.x;
    EXPECT_EQ(reversebits(c.x), c.reversed) << c.x;
  }
}

TEST(ShaderBitIntrinsics, FirstBitHighOfASignedNumberIsItsHighestNonSignBit) {
  EXPECT_EQ(firstbithigh(-1), ~0u);
  EXPECT_EQ(firstbithigh(0), ~0u);
  EXPECT_EQ(firstbithigh(-2), 0u);
  EXPECT_EQ(firstbithigh(kIntMin), 30u);
  EXPECT_EQ(firstbithigh(kIntMax), 30u);
  EXPECT_EQ(firstbithigh(int64_t{1} << 40), 40u);
  EXPECT_EQ(firstbithigh(int16_t{-32768}), 14u);
  EXPECT_EQ(firstbitlow(int16_t{-32768}), 15u);
  EXPECT_EQ(firstbitlow(int64_t{1} << 40), 40u);
  EXPECT_EQ(countbits(int16_t{-1}), 16u);
  EXPECT_EQ(countbits(~uint64_t{0}), 64u);
  EXPECT_EQ(reversebits(uint16_t{1}), 0x8000u);
  EXPECT_EQ(reversebits(uint64_t{1}), uint64_t{1} << 63);
  EXPECT_EQ(reversebits(int32_t{1}), kIntMin);
  expect_components(countbits(uint3{1, 3, 7}), {1, 2, 3});
}

TEST(ShaderBitIntrinsics, FloatClassesComeFromBits) {
  for (const float x : kFloats) {
    EXPECT_EQ(isnan(x), std::isnan(x)) << x;
    EXPECT_EQ(isinf(x), std::isinf(x)) << x;
    EXPECT_EQ(isfinite(x), std::isfinite(x)) << x;
    EXPECT_EQ(isnormal(x), std::isnormal(x)) << x;
  }
  EXPECT_TRUE(isnan(asfloat(0x7F800001u)));
  EXPECT_TRUE(isnan(half{0xFC01}));
  EXPECT_TRUE(isinf(half{0xFC00}));
  EXPECT_TRUE(isfinite(half{0x7BFF}));
  EXPECT_TRUE(isnormal(half{0x8400}));
  EXPECT_FALSE(isnormal(half{0x03FF}));
  EXPECT_FALSE(isnormal(half{0x7C00}));
  EXPECT_TRUE(isnormal(std::numeric_limits<double>::min()));
  EXPECT_FALSE(isnormal(std::numeric_limits<double>::denorm_min()));
  EXPECT_FALSE(isnormal(0.0));
  EXPECT_TRUE(isnan(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(isinf(-std::numeric_limits<double>::infinity()));
  expect_components(isnan(float3{1, kNan, kInf}), {0, 1, 0});
}

TEST(ShaderBitIntrinsics, Reinterpretation) {
  EXPECT_EQ(asuint(1.0f), 0x3F800000u);
  EXPECT_EQ(asuint(-1), 0xFFFFFFFFu);
  EXPECT_EQ(asuint(5u), 5u);
  EXPECT_EQ(asint(-0.0f), kIntMin);
  EXPECT_EQ(asfloat(0x40000000u), 2.0f);
  EXPECT_EQ(asfloat(0x40000000), 2.0f);
  EXPECT_EQ(asuint(asfloat(0x7FC12345u)), 0x7FC12345u);
  EXPECT_EQ(asuint16(half{0x3C00}), 0x3C00);
  EXPECT_EQ(asint16(half{0x8000}), -32768);
  EXPECT_EQ(asfloat16(uint16_t{0x3C00}).bits, 0x3C00);
  EXPECT_EQ(asdouble(0u, 0x3FF80000u), 1.5);
  EXPECT_EQ(asuint_low(1.1), 0x9999999Au);
  EXPECT_EQ(asuint_high(1.1), 0x3FF19999u);
  expect_components(asdouble(uint2{0, 0}, uint2{0x3FF00000u, 0x40000000u}), {1, 2});
  expect_components(asint(float2{0, 2}), {0, 0x40000000});
}

TEST(ShaderBitIntrinsics, HalfPacking) {
  EXPECT_EQ(f32tof16(1.0f), 0x3C00u);
  EXPECT_EQ(f32tof16(-2.0f), 0xC000u);
  EXPECT_EQ(f32tof16(65520.0f), 0x7C00u);
  EXPECT_EQ(f16tof32(0xABCD3C00u), 1.0f);
  EXPECT_EQ(f16tof32(0x0001u), 0x1p-24f);
  EXPECT_TRUE(isnan(f16tof32(0x7E00u)));
  expect_components(f16tof32(uint2{0x3C00u, 0x4000u}), {1, 2});
}

TEST(ShaderBitIntrinsics, AnyAllTakeEveryType) {
  EXPECT_TRUE(any(float3{0, 0, kNan}));
  EXPECT_FALSE(any(float3{0, -0.0f, 0}));
  EXPECT_TRUE(all(int2x2{1, 2, 3, 4}));
  EXPECT_FALSE(all(int2x2{1, 2, 0, 4}));
  EXPECT_TRUE(all(true));
  EXPECT_FALSE(any(0.0f));
  EXPECT_TRUE(all(bool4{true, true, true, true}));
  EXPECT_FALSE(any(half2{half{0x8000}, half{0}}));
}

TEST(ShaderBitIntrinsics, Msad4SkipsZeroReferenceBytes) {
  const uint2 source{0x07060504u, 0x0B0A0908u};
  // Window i has bytes 4+i .. 7+i.
  expect_components(msad4(0x01010101u, source, uint4{0, 100, 0, 0}), {18, 122, 26, 30});
  expect_components(msad4(0x00000001u, source, uint4{}), {3, 4, 5, 6});
  expect_components(msad4(0xFF000000u, source, uint4{}), {248, 247, 246, 245});
}

}  // namespace
}  // namespace kaamos::shader
