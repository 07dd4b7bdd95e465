// SPDX-License-Identifier: MIT
#include "effects/assets/scene/opacity_bake.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/assets/common/sampling.h"

namespace kaamos::effects {
namespace {

float random(std::uint32_t seed) {
  return unit_float(hash_combine(12345u, seed));
}

// Discs of alpha with soft edges.
TextureImage discs(std::uint32_t width, std::uint32_t height) {
  TextureImage image;
  image.width = width;
  image.height = height;
  image.mips.emplace_back(std::size_t{width} * height * 4);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const double fx = std::remainder(x + 0.5, 24.0), fy = std::remainder(y + 0.5, 24.0);
      const double alpha = std::clamp((9.0 - std::sqrt(fx * fx + fy * fy)) / 3, 0.0, 1.0);
      image.mips[0][(std::size_t{y} * width + x) * 4 + 3] =
          static_cast<std::uint8_t>(std::lround(255 * alpha));
    }
  }
  return image;
}

std::int64_t wrapped(std::int64_t i, std::int64_t size, Wrap wrap) {
  if (wrap == Wrap::kClamp) return std::clamp<std::int64_t>(i, 0, size - 1);
  const std::int64_t period = wrap == Wrap::kMirror ? 2 * size : size;
  const std::int64_t in = ((i % period) + period) % period;
  return in < size ? in : 2 * size - 1 - in;
}

// Alpha as a bilinear filter gives it, in float.
float alpha_at(const AlphaTest& test, glm::vec2 uv) {
  const TextureImage& image = *test.image;
  const glm::vec4 m = test.uv_matrix;
  const glm::vec2 moved =
      glm::vec2(m.x * uv.x + m.y * uv.y, m.z * uv.x + m.w * uv.y) + test.uv_offset;
  const float x = moved.x * static_cast<float>(image.width) - 0.5f;
  const float y = moved.y * static_cast<float>(image.height) - 0.5f;
  const float fx = x - std::floor(x), fy = y - std::floor(y);
  const auto texel = [&](int dx, int dy) {
    const auto ix =
        wrapped(static_cast<std::int64_t>(std::floor(x)) + dx, image.width, test.sampler.wrap_u);
    const auto iy =
        wrapped(static_cast<std::int64_t>(std::floor(y)) + dy, image.height, test.sampler.wrap_v);
    return image.mips[0][static_cast<std::size_t>(iy * image.width + ix) * 4 + 3] / 255.0f;
  };
  const float top = texel(0, 0) + fx * (texel(1, 0) - texel(0, 0));
  const float bottom = texel(0, 1) + fx * (texel(1, 1) - texel(0, 1));
  return test.factor * (top + fy * (bottom - top));
}

std::uint32_t state_of(const BakedMicromaps& baked, std::size_t triangle, std::uint32_t k) {
  const std::int32_t index = baked.indices[triangle];
  if (index < 0) return static_cast<std::uint32_t>(-1 - index);
  const BakedMicromap& one = baked.micromaps[static_cast<std::size_t>(index)];
  const std::uint8_t* bits = &baked.bits[one.byte_offset];
  return one.format == 1 ? bits[k / 8] >> k % 8 & 1 : bits[k / 4] >> 2 * (k % 4) & 3;
}

std::uint32_t level_of(const BakedMicromaps& baked, std::size_t triangle) {
  const std::int32_t index = baked.indices[triangle];
  return index < 0 ? 0 : baked.micromaps[static_cast<std::size_t>(index)].level;
}

using Uvs = std::array<glm::vec2, 3>;

// The corners of micro-triangle k, by DXR's definition.
Uvs corners_of(Uvs now, std::uint32_t level, std::uint32_t k) {
  while (level-- > 0) {
    const auto [a, b, c] = now;
    const glm::vec2 ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, ca = (c + a) * 0.5f;
    const Uvs quarters[] = {{a, ab, ca}, {ca, bc, ab}, {ab, b, bc}, {bc, ca, c}};
    now = quarters[k >> 2 * level & 3];
  }
  return now;
}

TEST(OpacityBake, KnownStatesAreWhatTheAlphaTestSays) {
  const TextureImage image = discs(64, 40);
  AlphaTest test;
  test.image = &image;
  test.uv_matrix = {1.1f, 0.2f, -0.3f, 0.9f};
  test.uv_offset = {0.05f, -0.4f};
  test.factor = 0.9f;
  std::vector<Uvs> triangles;
  for (std::uint32_t i = 0; i < 40; ++i) {
    Uvs& uvs = triangles.emplace_back();
    for (std::uint32_t c = 0; c < 3; ++c) {
      uvs[c] = {4 * random(6 * i + 2 * c) - 2, 4 * random(6 * i + 2 * c + 1) - 2};
      if (i % 2 != 0) uvs[c] *= 0.2f;
    }
  }
  for (const Wrap wrap : {Wrap::kRepeat, Wrap::kMirror, Wrap::kClamp}) {
    test.sampler.wrap_u = wrap;
    test.sampler.wrap_v = wrap == Wrap::kClamp ? Wrap::kRepeat : wrap;
    const BakedMicromaps baked = bake_micromaps(triangles, test);
    ASSERT_EQ(baked.indices.size(), triangles.size());
    EXPECT_GT(baked.shares[0], 0.05);
    EXPECT_GT(baked.shares[1], 0.02);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const std::uint32_t level = level_of(baked, i);
      for (std::uint32_t k = 0; k < 1u << 2 * level; ++k) {
        const std::uint32_t state = state_of(baked, i, k);
        if (state > 1) continue;
        const Uvs micro = corners_of(triangles[i], level, k);
        for (std::uint32_t n = 0; n < 8; ++n) {
          float a = random(1000 + 2 * n), b = random(1001 + 2 * n);
          if (a + b > 1) a = 1 - a, b = 1 - b;
          if (n < 3) a = n == 1 ? 1.0f : 0.0f, b = n == 2 ? 1.0f : 0.0f;
          const glm::vec2 uv = micro[0] + a * (micro[1] - micro[0]) + b * (micro[2] - micro[0]);
          ASSERT_EQ(alpha_at(test, uv) >= test.cutoff, state == 1)
              << "triangle " << i << ", micro-triangle " << k << " of level " << level;
        }
      }
    }
  }
}

TEST(OpacityBake, EqualTrianglesShareAMicromapAndUniformOnesNeedNone) {
  TextureImage image = discs(48, 48);
  AlphaTest test;
  test.image = &image;
  const Uvs whole = {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)};
  const Uvs inside = {glm::vec2(0.02f, 0.02f), glm::vec2(0.05f, 0.02f), glm::vec2(0.02f, 0.05f)};
  const std::vector<Uvs> triangles = {whole, inside, whole};
  const BakedMicromaps baked = bake_micromaps(triangles, test);
  EXPECT_EQ(baked.indices, (std::vector<std::int32_t>{0, -2, 0}));
  EXPECT_EQ(baked.micromaps.size(), 1u);
  EXPECT_EQ(baked.micromaps[0].level, 7u);  // 68 texels
  EXPECT_EQ(baked.bits.size(), 4096u);

  BakeOptions two;
  two.two_states = true;
  two.max_level = 4;
  const BakedMicromaps coarse = bake_micromaps(triangles, test, two);
  EXPECT_EQ(coarse.micromaps[0].level, 4u);
  EXPECT_EQ(coarse.micromaps[0].format, 1u);
  EXPECT_EQ(coarse.bits.size(), 32u);
  EXPECT_EQ(coarse.shares[2] + coarse.shares[3], 0.0);

  test.image = nullptr;
  test.factor = 0.4f;
  EXPECT_EQ(bake_micromaps(triangles, test).indices, (std::vector<std::int32_t>(3, -1)));
}

TEST(OpacityBake, CoordinatesThatAreNoNumbersStayUnknown) {
  const TextureImage image = discs(16, 16);
  AlphaTest test;
  test.image = &image;
  const std::vector<Uvs> triangles = {
      {glm::vec2(std::nanf(""), 0), glm::vec2(1, 0), glm::vec2(0, 1)},
      {glm::vec2(1e30f, 0), glm::vec2(-1e30f, 0), glm::vec2(0, 1e30f)}};
  const BakedMicromaps baked = bake_micromaps(triangles, test);
  EXPECT_EQ(baked.indices[0], -4);
  for (std::uint32_t k = 0; k < 1u << 2 * level_of(baked, 1); ++k) {
    EXPECT_GT(state_of(baked, 1, k), 1u);
  }
}

}  // namespace
}  // namespace kaamos::effects
