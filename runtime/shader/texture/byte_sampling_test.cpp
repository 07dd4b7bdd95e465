// SPDX-License-Identifier: MIT
//
// Samples taken on the short path have the bits of the long one.
#include "runtime/shader/texture/byte_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "runtime/shader/texture/texture_test_support.h"

namespace kaamos::shader {
namespace {

constexpr uint32_t kLinear = 0x15, kAnisotropic = 0x55;

struct ByteTexture : TestTexture {
  ByteTexture(uint32_t format, uint32_t width, uint32_t height, uint32_t mips)
      : TestTexture(TextureDimension::k2D, kFormatRgba8Unorm, width, height, 1, mips,
                    [](uint32_t x, uint32_t y, uint32_t, uint32_t mip) {
                      const auto value = [&](uint32_t i) {
                        const uint32_t hash = (x * 73 + y * 151 + mip * 37 + i * 89) * 2654435761u;
                        return static_cast<float>(hash >> 24) / 255.0f;
                      };
                      return float_texel(value(0), value(1), value(2), value(3));
                    }) {
    view.format = view.direct_format = format;
  }
};

// Takes the short path; without direct_format the same view takes the long one.
void expect_same(ByteTexture& texture, const TestSampler& sampler, SampleArguments arguments) {
  arguments.texture = &texture.descriptor;
  arguments.sampler = &sampler.descriptor;
  Texel texel = {};
  ASSERT_TRUE(sample_bytes(arguments, texel));
  const uint32_t format = texture.view.direct_format;
  texture.view.direct_format = 0;
  const Texel expected = sample_level(arguments);
  texture.view.direct_format = format;
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(texel.bits[i], expected.bits[i])
        << "channel " << i << " at " << arguments.coordinates[0] << ", " << arguments.coordinates[1]
        << ", lod " << arguments.lod;
  }
}

TEST(ByteSampling, HasTheBitsOfTheLongWay) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-2.5f, 3.5f), lod(-1.0f, 6.0f);
  for (const uint32_t format : {kFormatRgba8Unorm, kFormatRgba8Srgb}) {
    ByteTexture texture(format, 37, 16, 5);
    for (const uint32_t address : {1u, 2u, 3u}) {
      for (const uint32_t filter : {kLinear, kAnisotropic}) {
        TestSampler sampler(filter, address);
        sampler.state.mip_lod_bias = 0.25f;
        for (int i = 0; i < 2000; ++i) {
          SampleArguments arguments = {};
          arguments.coordinates[0] = coordinate(random);
          arguments.coordinates[1] = coordinate(random);
          // Every third is a whole level, so that only one mip is read.
          arguments.lod = i % 3 == 0 ? std::floor(lod(random)) - 0.25f : lod(random);
          expect_same(texture, sampler, arguments);
        }
      }
    }
  }
}

TEST(ByteSampling, TakesWhatIsNoNumber) {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  ByteTexture texture(kFormatRgba8Srgb, 16, 8, 4);
  for (const uint32_t address : {1u, 2u, 3u}) {
    const TestSampler sampler(kLinear, address);
    for (const float u : {nan, infinity, -infinity, 1e30f, -0.0f, 1.0f}) {
      for (const float lod : {0.0f, nan, infinity, -infinity, 1.5f}) {
        SampleArguments arguments = {};
        arguments.coordinates[0] = u;
        arguments.coordinates[1] = 0.3f;
        arguments.lod = lod;
        expect_same(texture, sampler, arguments);
      }
    }
  }
}

TEST(ByteSampling, LeavesAllElseAlone) {
  ByteTexture texture(kFormatRgba8Unorm, 16, 8, 4);
  const TestSampler linear(kLinear);
  SampleArguments arguments = sample_arguments(texture, linear, 0.3f, 0.4f);
  Texel texel = {};
  EXPECT_TRUE(sample_bytes(arguments, texel));
  const TestSampler point(0), border(kLinear, 4), once(kLinear, 5), minimum(kLinear | 2u << 7);
  for (const TestSampler* sampler : {&point, &border, &once, &minimum}) {
    arguments.sampler = &sampler->descriptor;
    EXPECT_FALSE(sample_bytes(arguments, texel)) << sampler->state.filter;
  }
  arguments.sampler = &linear.descriptor;
  arguments.offset[1] = 1;
  EXPECT_FALSE(sample_bytes(arguments, texel));
  arguments.offset[1] = 0;
  texture.view.mips[1].texels = nullptr;
  arguments.lod = 0.5f;
  EXPECT_FALSE(sample_bytes(arguments, texel));
  texture.view.direct_format = kFormatR32Float;
  EXPECT_FALSE(sample_bytes(arguments, texel));
}

}  // namespace
}  // namespace kaamos::shader
