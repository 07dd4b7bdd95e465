// SPDX-License-Identifier: MIT
//
// Compares filtered reads with a reference in double that follows the definitions: one texel at a
// time, address modes by stepping, blending as a weighted sum. Coordinates are multiples of 1/64
// and sizes small, so that float loses nothing and both choose the same texels.
#include "runtime/shader/texture/texture_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/shader/texture/texture_test_support.h"

namespace kaamos::shader {
namespace {

using D = TextureDimension;
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr uint32_t kPoint = 0, kTrilinear = 0x15, kBilinear = 0x14;

struct Random {
  uint32_t state = 1;
  int below(int n) {
    state = state * 1664525u + 1013904223u;
    return static_cast<int>((state >> 8) % static_cast<uint32_t>(n));
  }
};

Texel noise(uint32_t x, uint32_t y, uint32_t slice, uint32_t mip) {
  const uint32_t h = (x * 73u + y * 151u + slice * 283u + mip * 389u) * 2654435761u;
  return float_texel(static_cast<float>(h >> 24) / 64, static_cast<float>(h >> 16 & 255u) / 64,
                     static_cast<float>(h >> 8 & 255u) / 64, static_cast<float>(h & 255u) / 64);
}

// ---------------------------------------------------------------------------------------------
// The reference

// Walks to the texture from outside. -1: border.
int walk(uint32_t mode, int i, int size) {
  switch (mode) {
    case 2:
      while (i < 0 || i >= size) i = i < 0 ? -1 - i : 2 * size - 1 - i;
      return i;
    case 3:
      return std::min(std::max(i, 0), size - 1);
    case 4:
      return i < 0 || i >= size ? -1 : i;
    case 5:
      return std::min(i < 0 ? -1 - i : i, size - 1);
    default:
      while (i < 0) i += size;
      while (i >= size) i -= size;
      return i;
  }
}

struct Reference {
  const TestTexture& texture;
  const TestSampler& sampler;
  double u[3];
  int offset[3];
  int axes;
  uint32_t slice;

  double texel(uint32_t mip, const int at[3], int c) const {
    const TextureMip& m = texture.view.mips[mip];
    const int size[3] = {int(m.width), int(m.height), int(m.depth)};
    int place[3] = {0, 0, int(slice)};
    for (int i = 0; i < axes; ++i) {
      place[i] = walk(sampler.state.address[i], at[i] + offset[i], size[i]);
      if (place[i] < 0) return static_cast<double>(sampler.state.border_color[c]);
    }
    return static_cast<double>(channel(noise(place[0], place[1], place[2], mip), c));
  }

  double on_mip(uint32_t mip, bool linear, int c) const {
    const TextureMip& m = texture.view.mips[mip];
    const double size[3] = {double(m.width), double(m.height), double(m.depth)};
    double sum = 0;
    for (int corner = 0; corner < (linear ? 1 << axes : 1); ++corner) {
      int at[3] = {};
      double weight = 1;
      for (int i = 0; i < axes; ++i) {
        const double x = u[i] * size[i] - (linear ? 0.5 : 0);
        const double whole = std::floor(x);
        at[i] = static_cast<int>(whole) + (corner >> i & 1);
        if (linear) weight *= (corner >> i & 1) != 0 ? x - whole : 1 - (x - whole);
      }
      sum += weight * texel(mip, at, c);
    }
    return sum;
  }

  double at_lod(double lod, int c) const {
    const SamplerState& s = sampler.state;
    lod = std::min(std::max(lod + s.mip_lod_bias, double(s.min_lod)), double(s.max_lod));
    const bool linear = (s.filter & (lod > 0 ? 16u : 4u)) != 0;
    const double last = texture.view.mip_count - 1.0;
    lod = std::min(std::max(lod, 0.0), last);
    if ((s.filter & 1u) == 0) return on_mip(uint32_t(std::floor(lod + 0.5)), linear, c);
    const double level = std::floor(lod);
    const double low = on_mip(uint32_t(level), linear, c);
    if (lod == level) return low;
    return low * (1 - (lod - level)) + on_mip(uint32_t(level) + 1, linear, c) * (lod - level);
  }
};

struct Shape {
  D dimension;
  uint32_t width, height, slices, mips;
  int axes;
};

TEST(TextureSampling, AgreesWithTheReference) {
  const Shape shapes[] = {{D::k2D, 8, 4, 1, 4, 2},     {D::k2D, 5, 3, 1, 3, 2},
                          {D::k2D, 1, 1, 1, 1, 2},     {D::k1D, 8, 1, 1, 4, 1},
                          {D::k3D, 4, 8, 4, 3, 3},     {D::k2DArray, 4, 4, 3, 3, 2},
                          {D::k1DArray, 6, 1, 4, 2, 1}};
  Random random;
  for (const Shape& shape : shapes) {
    TestTexture texture(shape.dimension, kFormatRgba32Float, shape.width, shape.height,
                        shape.slices, shape.mips, noise);
    for (const uint32_t filter : {0u, 1u, 4u, 5u, 0x10u, 0x11u, 0x14u, 0x15u, 0x55u}) {
      for (int round = 0; round < 150; ++round) {
        TestSampler sampler(filter);
        for (uint32_t& mode : sampler.state.address) mode = 1 + random.below(5);
        for (float& border : sampler.state.border_color) border = 7.5f;
        sampler.state.mip_lod_bias = static_cast<float>(random.below(5) - 2) / 4;
        if (random.below(3) == 0) sampler.state.min_lod = 0.75f;
        if (random.below(3) == 0) sampler.state.max_lod = 1.25f;
        Reference reference{texture, sampler, {}, {}, shape.axes, 0};
        SampleArguments arguments = sample_arguments(texture, sampler, 0);
        for (int i = 0; i < shape.axes; ++i) {
          arguments.coordinates[i] = static_cast<float>(random.below(513) - 256) / 64;
          arguments.offset[i] = random.below(17) - 8;
          reference.u[i] = static_cast<double>(arguments.coordinates[i]);
          reference.offset[i] = arguments.offset[i];
        }
        if (shape.dimension == D::k2DArray || shape.dimension == D::k1DArray) {
          const float element = static_cast<float>(random.below(25) - 8) / 4;
          arguments.coordinates[shape.axes] = element;
          reference.slice = static_cast<uint32_t>(
              std::min(std::max(std::nearbyint(element), 0.0f), float(shape.slices - 1)));
        }
        arguments.lod = static_cast<float>(random.below(41) - 8) / 8;
        const Texel texel = sample_level(arguments);
        for (int c = 0; c < 4; ++c) {
          ASSERT_NEAR(channel(texel, c), reference.at_lod(static_cast<double>(arguments.lod), c),
                      1e-5)
              << "dimension " << int(shape.dimension) << " filter " << filter << " u "
              << arguments.coordinates[0] << " v " << arguments.coordinates[1] << " modes "
              << sampler.state.address[0] << sampler.state.address[1] << " lod " << arguments.lod;
        }
      }
    }
  }
}

TEST(TextureSampling, WildCoordinatesStayInside) {
  const float wild[] = {kNan,   kInf,   -kInf, 1e9f, -1e9f, 3e38f,      -3e38f,
                        1e-45f, -1e-9f, -0.0f, 1.0f, 2.0f,  16777217.0f};
  for (const D dimension : {D::k1D, D::k2D, D::k3D, D::kCube, D::k2DArray, D::kCubeArray}) {
    const bool cube = dimension == D::kCube || dimension == D::kCubeArray;
    TestTexture texture(dimension, kFormatRgba32Float, 4, dimension == D::k1D ? 1 : 4,
                        cube                                         ? 12
                        : dimension == D::k1D || dimension == D::k2D ? 1
                                                                     : 4,
                        3, noise);
    for (uint32_t mode = 0; mode <= 6; ++mode) {
      for (const uint32_t filter : {kPoint, kTrilinear, 0x115u, 0x195u}) {
        TestSampler sampler(filter, mode);
        for (const float u : wild) {
          for (const float v : wild) {
            SampleArguments a = sample_arguments(texture, sampler, u, v, v, u);
            a.lod = v;
            a.offset[0] = std::numeric_limits<int32_t>::max();
            a.offset[1] = std::numeric_limits<int32_t>::min();
            a.ddx[0] = u, a.ddx[1] = v, a.ddy[2] = v;
            a.comparison = u;
            for (const Texel& texel : {sample_level(a), sample_gradient(a), gather(a)}) {
              for (int c = 0; c < 4; ++c) {
                EXPECT_GE(channel(texel, c), 0.0f);
                EXPECT_LE(channel(texel, c), 4.0f);
              }
            }
            const float share = sample_compare_level(a);
            EXPECT_TRUE(share >= 0.0f && share <= 1.0f);
            gather_compare(a);
          }
        }
      }
    }
  }
}

TEST(TextureSampling, NullsGiveZeros) {
  TestTexture texture(D::k2D, kFormatRgba32Float, 4, 4, 1, 1, noise);
  TestSampler sampler(kTrilinear);
  const Descriptor null;
  SampleArguments a = sample_arguments(texture, sampler, 0.5f, 0.5f);
  a.texture = &null;
  EXPECT_EQ(sample_level(a).bits[3], 0u);
  a.texture = &texture.descriptor;
  a.sampler = &null;
  EXPECT_EQ(sample_level(a).bits[3], 0u);
  a.sampler = &sampler.descriptor;
  EXPECT_NE(sample_level(a).bits[3], 0u);
  texture.view.format = 71;
  EXPECT_EQ(sample_level(a).bits[3], 0u);
  EXPECT_EQ(sample_compare_level(a), 0.0f);
}

TEST(TextureSampling, EqualTexelsBlendToThemselves) {
  TestTexture texture(D::k3D, kFormatRgba8Unorm, 8, 8, 8, 4,
                      [](auto...) { return float_texel(0.3f, 0.6f, 0.9f, 1.0f); });
  TestSampler sampler(kTrilinear);
  for (int i = 0; i < 100; ++i) {
    const float u = static_cast<float>(i) * 0.0173f;
    SampleArguments a = sample_arguments(texture, sampler, u, u * 2, u * 3);
    a.lod = u;
    EXPECT_EQ(channel(sample_level(a), 0), 77 / 255.0f);
    EXPECT_EQ(channel(sample_level(a), 3), 1.0f);
  }
}

TEST(TextureSampling, ExactTexelCentresIgnoreInfiniteNeighbours) {
  TestTexture texture(D::k2D, kFormatRgba32Float, 2, 1, 1, 1, [](uint32_t x, auto...) {
    return x == 0 ? float_texel(1, 1, 1, 1) : float_texel(kInf, kNan, kInf, kNan);
  });
  TestSampler sampler(kBilinear, 3);
  const Texel texel = sample_level(sample_arguments(texture, sampler, 0.25f, 0.5f));
  for (int c = 0; c < 4; ++c) EXPECT_EQ(channel(texel, c), 1.0f);
}

TEST(TextureSampling, SrgbIsDecodedBeforeBlending) {
  uint8_t bytes[8] = {0, 0, 0, 255, 255, 255, 255, 255};
  TestTexture texture(D::k2D, kFormatRgba8Unorm, 2, 1, 1, 1, noise);
  texture.view.format = kFormatRgba8Srgb;
  texture.view.mips[0].texels = bytes;
  TestSampler sampler(kBilinear, 3);
  EXPECT_EQ(channel(sample_level(sample_arguments(texture, sampler, 0.5f, 0.5f)), 0), 0.5f);
}

TEST(TextureSampling, MinimumAndMaximumOfTheTexelsThatCount) {
  TestTexture texture(D::k2D, kFormatR32Float, 2, 2, 1, 1, [](uint32_t x, uint32_t y, auto...) {
    return float_texel(static_cast<float>(x + 2 * y));
  });
  TestSampler low(0x115, 3), high(0x195, 3);
  EXPECT_EQ(channel(sample_level(sample_arguments(texture, low, 0.5f, 0.5f)), 0), 0.0f);
  EXPECT_EQ(channel(sample_level(sample_arguments(texture, high, 0.5f, 0.5f)), 0), 3.0f);
  // At the centre of a texel the others have no weight.
  EXPECT_EQ(channel(sample_level(sample_arguments(texture, low, 0.75f, 0.75f)), 0), 3.0f);
  EXPECT_EQ(channel(sample_level(sample_arguments(texture, high, 0.25f, 0.25f)), 0), 0.0f);
}

TEST(TextureSampling, IntegersAreNeverBlended) {
  TestTexture texture(D::k2D, kFormatRgba32Uint, 2, 2, 1, 2, [](uint32_t x, auto...) {
    return Texel{{0x7F800001u + x, 0xFFFFFFFFu, 0, 5}};
  });
  TestSampler sampler(kTrilinear, 3);
  SampleArguments a = sample_arguments(texture, sampler, 0.6f, 0.5f);
  a.lod = 0.25f;
  EXPECT_EQ(sample_level(a).bits[0], 0x7F800002u);
  EXPECT_EQ(sample_level(a).bits[1], 0xFFFFFFFFu);
}

TEST(TextureSampling, BorderLacksWhatTheFormatLacks) {
  TestTexture texture(D::k2D, kFormatR8Unorm, 2, 2, 1, 1, noise);
  TestSampler sampler(kPoint, 4);
  for (float& border : sampler.state.border_color) border = 0.5f;
  const Texel texel = sample_level(sample_arguments(texture, sampler, 2, 2));
  EXPECT_EQ(channel(texel, 0), 0.5f);
  EXPECT_EQ(channel(texel, 1), 0.0f);
  EXPECT_EQ(channel(texel, 3), 1.0f);
}

TEST(TextureSampling, ComponentMappingFollowsFiltering) {
  TestTexture texture(D::k2D, kFormatRgba32Float, 1, 1, 1, 1,
                      [](auto...) { return float_texel(10, 20, 30, 40); });
  const uint8_t mapping[4] = {3, 2, 4, 5};
  std::copy(mapping, mapping + 4, texture.view.swizzle);
  TestSampler sampler(kTrilinear);
  SampleArguments a = sample_arguments(texture, sampler, 0.5f, 0.5f);
  const Texel texel = sample_level(a);
  EXPECT_EQ(channel(texel, 0), 40.0f);
  EXPECT_EQ(channel(texel, 1), 30.0f);
  EXPECT_EQ(channel(texel, 2), 0.0f);
  EXPECT_EQ(channel(texel, 3), 1.0f);
  a.component = 0;
  EXPECT_EQ(channel(gather(a), 2), 40.0f);
}

// ---------------------------------------------------------------------------------------------
// Levels of detail

// Each mip contains its own number.
struct Mips : testing::Test {
  TestTexture texture{
      D::k2D, kFormatR32Float, 64, 32, 1, 6, [](uint32_t, uint32_t, uint32_t, uint32_t mip) {
        return float_texel(static_cast<float>(mip));
      }};
  TestSampler sampler{kTrilinear};
  SampleArguments arguments = sample_arguments(texture, sampler, 0.3f, 0.7f);

  float level(float lod) {
    arguments.lod = lod;
    return channel(sample_level(arguments), 0);
  }
  float gradient(float x0, float x1, float y0, float y1) {
    const float g[4] = {x0, x1, y0, y1};
    std::copy(g, g + 2, arguments.ddx);
    std::copy(g + 2, g + 4, arguments.ddy);
    return channel(sample_gradient(arguments), 0);
  }
};

TEST_F(Mips, LevelIsClampedToTheChain) {
  EXPECT_EQ(level(2.5f), 2.5f);
  EXPECT_EQ(level(-3), 0.0f);
  EXPECT_EQ(level(99), 5.0f);
  EXPECT_EQ(level(kNan), 0.0f);
  EXPECT_EQ(level(kInf), 5.0f);
  sampler.state.mip_lod_bias = 1.5f;
  EXPECT_EQ(level(1), 2.5f);
  sampler.state.max_lod = 2;
  EXPECT_EQ(level(1), 2.0f);
  sampler.state.min_lod = 1.75f;
  EXPECT_EQ(level(-5), 1.75f);
}

TEST_F(Mips, ViewAndCallClampToo) {
  texture.view.min_lod = 1.5f;
  EXPECT_EQ(level(0), 1.5f);
  arguments.min_lod = 2.25f;
  EXPECT_EQ(level(0), 2.25f);
}

TEST_F(Mips, PointMipsRoundToTheNearest) {
  sampler.state.filter = kBilinear;
  EXPECT_EQ(level(1.49f), 1.0f);
  EXPECT_EQ(level(1.5f), 2.0f);
}

TEST_F(Mips, GradientsGiveTheLongerAxis) {
  EXPECT_FLOAT_EQ(gradient(1 / 64.0f, 0, 0, 1 / 32.0f), 0.0f);
  EXPECT_FLOAT_EQ(gradient(4 / 64.0f, 0, 0, 1 / 32.0f), 2.0f);
  EXPECT_FLOAT_EQ(gradient(0, 0, 0, 8 / 32.0f), 3.0f);
  EXPECT_NEAR(gradient(2 / 64.0f, 2 / 32.0f, 0, 0), 1.5f, 1e-6f);
  EXPECT_EQ(gradient(0, 0, 0, 0), 0.0f);
  EXPECT_EQ(gradient(kInf, 0, 0, 0), 5.0f);
}

// ---------------------------------------------------------------------------------------------
// Comparison and gather

TEST(TextureComparison, CountsTheTexelsThatPass) {
  TestTexture depth(D::k2D, kFormatR32Float, 2, 2, 1, 1, [](uint32_t x, uint32_t y, auto...) {
    return float_texel(0.1f * static_cast<float>(1 + x + 2 * y));
  });
  TestSampler sampler(0x94, 3);  // comparison, bilinear
  struct Case {
    uint32_t function;
    float reference, share;
  };
  const Case cases[] = {{1, 0.25f, 0},     {2, 0.25f, 0.5f}, {4, 0.25f, 0.5f}, {5, 0.25f, 0.5f},
                        {5, 0.15f, 0.25f}, {7, 0.45f, 1},    {6, 0.1f, 0.75f}, {3, 0.1f, 0.25f},
                        {8, 0.0f, 1},      {2, kNan, 0},     {6, kNan, 1}};
  for (const Case& c : cases) {
    sampler.state.comparison = c.function;
    SampleArguments a = sample_arguments(depth, sampler, 0.5f, 0.5f);
    a.comparison = c.reference;
    EXPECT_EQ(sample_compare_level(a), c.share) << c.function << " " << c.reference;
  }
}

TEST(TextureComparison, ReferenceIsClampedForNormalizedFormats) {
  TestTexture depth(D::k2D, 56, 2, 2, 1, 1, [](auto...) { return float_texel(1.0f); });
  TestSampler sampler(0x94, 3);
  sampler.state.comparison = 4;  // reference <= texel
  SampleArguments a = sample_arguments(depth, sampler, 0.5f, 0.5f);
  a.comparison = 1.5f;
  EXPECT_EQ(sample_compare_level(a), 1.0f);
}

TEST(TextureGather, OrderIsCounterClockwiseFromTheLowerLeft) {
  TestTexture texture(D::k2DArray, kFormatRgba32Float, 4, 4, 2, 2,
                      [](uint32_t x, uint32_t y, uint32_t slice, uint32_t mip) {
                        return float_texel(static_cast<float>(x + 10 * y + 100 * slice),
                                           static_cast<float>(mip), 7, 8);
                      });
  TestSampler sampler(kPoint, 1);
  SampleArguments a = sample_arguments(texture, sampler, 0.5f, 0.5f, 1);
  Texel t = gather(a);
  EXPECT_EQ(channel(t, 0), 121.0f);  // (1, 2)
  EXPECT_EQ(channel(t, 1), 122.0f);  // (2, 2)
  EXPECT_EQ(channel(t, 2), 112.0f);  // (2, 1)
  EXPECT_EQ(channel(t, 3), 111.0f);  // (1, 1)
  a.component = 3;
  EXPECT_EQ(channel(gather(a), 0), 8.0f);
  a.component = 0;
  a.offset[0] = 2;
  EXPECT_EQ(channel(gather(a), 1), 120.0f);  // wrapped to (0, 2)
  a.offset[0] = 0;
  sampler.state.comparison = 5;  // reference > texel
  a.comparison = 112.0f;
  t = gather_compare(a);
  EXPECT_EQ(channel(t, 0), 0.0f);
  EXPECT_EQ(channel(t, 2), 0.0f);
  EXPECT_EQ(channel(t, 3), 1.0f);
}

}  // namespace
}  // namespace kaamos::shader
