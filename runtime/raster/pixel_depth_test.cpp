// SPDX-License-Identifier: MIT
//
// Depth: RAS-58 to RAS-71, RAS-130.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/raster/testing/random_triangles.h"
#include "runtime/raster/testing/reference.h"
#include "runtime/raster/testing/scene.h"

namespace kaamos::raster {
namespace {

using rtapi::ComparisonFunc;
using rtapi::Format;
using testing::as_bits;
using testing::as_float;
using testing::Scene;
using testing::TestTexture;

// A quad over the target whose z is `left` and `right` at its borders.
void add_slope(Scene& scene, float left, float right) {
  for (const auto& [x, y] : {std::pair{-1.0f, 1.0f},
                             {1.0f, 1.0f},
                             {-1.0f, -1.0f},
                             {-1.0f, -1.0f},
                             {1.0f, 1.0f},
                             {1.0f, -1.0f}}) {
    scene.vertex(x, y, x < 0 ? left : right, 1);
  }
}

// Returns what a pixel shader reads in SV_Position.z of a quad at depth z.
uint32_t position_z(Scene& scene) {
  TestTexture& target = scene.add_target(Format::kR32Float);
  scene.shade_columns(scene.add_pixel_input(scene.linked.pixel_columns.position, 3) + 2, 1);
  scene.run();
  return target.at<uint32_t>(7, 9);
}

TEST(RasterDepth, PlanesAreExact) {  // RAS-58, RAS-59
  Scene scene;
  TestTexture& target = scene.add_target(Format::kR32Float);
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  scene.shade_columns(scene.add_pixel_input(scene.linked.pixel_columns.position, 3) + 2, 1);
  add_slope(scene, 0, 1);
  scene.run();
  for (uint32_t y = 0; y < 256; ++y) {
    for (uint32_t x = 0; x < 256; ++x) {
      ASSERT_EQ(depth.at<float>(x, y), (static_cast<float>(x) + 0.5f) / 256);
      ASSERT_EQ(target.at<uint32_t>(x, y), depth.at<uint32_t>(x, y));
    }
  }
}

// RAS-59 and RAS-70 on random triangles.
void compare_depth(testing::TriangleKind kind) {
  constexpr uint32_t kSize = 200;
  std::mt19937 random(21);
  const uint32_t triangles = testing::random_triangle_count() / 4;
  Scene scene(kSize, kSize);
  TestTexture& target = scene.add_target(Format::kR32Float);
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  scene.shade_columns(scene.add_pixel_input(scene.linked.pixel_columns.position, 3) + 2, 1);
  for (uint32_t i = 0; i < triangles; ++i) {
    scene.clear_vertices();
    depth.fill(-1.0f);
    target.fill(-1.0f);
    testing::add_random_triangles(scene, kind, 1, random);
    scene.run();
    const testing::ReferenceTriangle triangle(testing::corners_of(scene, 0).v,
                                              scene.state.viewports[0]);
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) {
        ASSERT_EQ(target.at<uint32_t>(x, y), depth.at<uint32_t>(x, y));
        const float stored = depth.at<float>(x, y);
        if (stored == -1.0f) continue;
        const long double exact = triangle.depth(static_cast<int32_t>(x), static_cast<int32_t>(y));
        const double error = static_cast<double>(static_cast<long double>(stored) - exact);
        ASSERT_LE(std::fabs(error), 0x1p-24 * std::fabs(static_cast<double>(stored)) + 0x1p-25)
            << "triangle " << i << ", pixel " << x << ' ' << y;
      }
    }
  }
}
TEST(RasterDepth, SmallTrianglesAreExact) {
  compare_depth(testing::TriangleKind::kSmall);
}
TEST(RasterDepth, MediumTrianglesAreExact) {
  compare_depth(testing::TriangleKind::kMedium);
}
TEST(RasterDepth, SliversAreExact) {
  compare_depth(testing::TriangleKind::kSliver);
}
TEST(RasterDepth, HugeTrianglesAreExact) {
  compare_depth(testing::TriangleKind::kHuge);
}

template <class T>
void expect_stored(Format format, float z, T expected, T mask) {
  Scene scene(64, 64);
  TestTexture& depth = scene.add_depth(format);
  scene.quad_px(0, 0, 64, 64, z);
  scene.run();
  for (uint32_t i = 0; i < 64; ++i) {
    EXPECT_EQ(depth.at<T>(i, 63 - i) & mask, expected) << z;
  }
  // The converted value is compared.
  scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kLess;
  TestTexture& target = scene.add_target(Format::kR32Float);
  scene.shade_constant(1, 1, 1, 1);
  scene.run();
  EXPECT_EQ(target.count(0.0f), 64u * 64u);
  scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kEqual;
  scene.run();
  EXPECT_EQ(target.count(1.0f), 64u * 64u);
  EXPECT_TRUE(depth.padding_is_intact());
}

TEST(RasterDepth, UnormRoundsToNearest) {  // RAS-60, RAS-71
  expect_stored<uint16_t>(Format::kD16Unorm, 0.5f, 32768, 0xFFFF);
  expect_stored<uint16_t>(Format::kD16Unorm, 1.0f, 65535, 0xFFFF);
  expect_stored<uint16_t>(Format::kD16Unorm, 0.49f / 65535, 0, 0xFFFF);
  expect_stored<uint16_t>(Format::kD16Unorm, 0.51f / 65535, 1, 0xFFFF);
  expect_stored<uint32_t>(Format::kD24UnormS8Uint, 0.5f, 8388608, 0xFFFFFF);
  expect_stored<uint32_t>(Format::kD24UnormS8Uint, 1.0f, 16777215, 0xFFFFFF);
  expect_stored<uint32_t>(Format::kD24UnormS8Uint, 1 - 0x1p-24f, 16777214, 0xFFFFFF);
  expect_stored<uint32_t>(Format::kD24UnormS8Uint, 0.7f, 11744050, 0xFFFFFF);
  expect_stored<uint32_t>(Format::kD32FloatS8X24Uint, 0.3f, as_bits(0.3f), 0xFFFFFFFF);
}

TEST(RasterDepth, StencilStays) {  // RAS-71
  Scene scene(65, 67);
  TestTexture& depth = scene.add_depth(Format::kD24UnormS8Uint);
  depth.fill(0xAB000000u);
  scene.quad_px(0, 0, 65, 67);
  scene.run();
  EXPECT_EQ(depth.count(0xAB800000u), 65u * 67u);
  Scene wide(65, 67);
  TestTexture& wide_depth = wide.add_depth(Format::kD32FloatS8X24Uint);
  wide_depth.fill(uint64_t{0x1234567800000000});
  wide.quad_px(0, 0, 65, 67);
  wide.run();
  EXPECT_EQ(wide_depth.count(uint64_t{0x1234567800000000} | as_bits(0.5f)), 65u * 67u);
}

TEST(RasterDepth, Comparisons) {  // RAS-61
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const float stored[4] = {0.25f, 0.5f, 0.75f, kNaN};
  // A bit for each stored value that depth 0.5 passes against, by function.
  const uint32_t passes[9] = {0, 0, 4, 2, 6, 1, 1 | 4 | 8, 3, 15};
  for (uint32_t func = 1; func <= 8; ++func) {
    for (const Format format : {Format::kD32Float, Format::kD16Unorm, Format::kD24UnormS8Uint}) {
      for (uint32_t i = 0; i < 4; ++i) {
        if (i == 3 && format != Format::kD32Float) continue;
        Scene scene(64, 64);
        TestTexture& depth = scene.add_depth(format);
        TestTexture& target = scene.add_target(Format::kR32Float);
        if (i == 3) {
          depth.fill(kNaN);
        } else {
          scene.quad_px(0, 0, 64, 64, stored[i]);
          scene.run();
          scene.clear_vertices();
        }
        scene.shade_constant(1, 1, 1, 1);
        scene.linked.depth_stencil.DepthFunc = static_cast<ComparisonFunc>(func);
        scene.quad_px(0, 0, 64, 64, 0.5f);
        scene.run();
        EXPECT_EQ(target.count(1.0f), (passes[func] >> i & 1) != 0 ? 4096u : 0u)
            << func << ' ' << stored[i] << ' ' << static_cast<int>(format);
      }
    }
  }
  // -0 equals 0.
  Scene scene(64, 64);
  scene.add_depth(Format::kD32Float).fill(-0.0f);
  TestTexture& target = scene.add_target(Format::kR32Float);
  scene.shade_constant(1, 1, 1, 1);
  scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kEqual;
  scene.quad_px(0, 0, 64, 64, 0);
  scene.run();
  EXPECT_EQ(target.count(1.0f), 4096u);
}

TEST(RasterDepth, WithoutTestNoWrite) {  // RAS-62
  Scene scene(64, 64);
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  depth.fill(0.125f);
  TestTexture& target = scene.add_target(Format::kR32Float);
  scene.shade_constant(1, 1, 1, 1);
  scene.linked.depth_stencil.DepthEnable = false;
  scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kNever;
  scene.quad_px(0, 0, 64, 64);
  scene.run();
  EXPECT_EQ(depth.count(0.125f), 4096u);
  EXPECT_EQ(target.count(1.0f), 4096u);
  // No target of depth.
  scene.depth.reset();
  target.fill(0.0f);
  scene.linked.depth_stencil.DepthEnable = true;
  scene.run();
  EXPECT_EQ(target.count(1.0f), 4096u);
}

TEST(RasterDepth, ReadOnlyDepthIsTestedOnly) {  // RAS-130
  Scene scene(64, 64);
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  depth.fill(0.75f);
  TestTexture& target = scene.add_target(Format::kR32Float);
  scene.shade_constant(1, 1, 1, 1);
  scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kLess;
  scene.quad_px(0, 0, 32, 64, 0.5f);
  scene.quad_px(32, 0, 64, 64, 0.8f);
  Targets targets = scene.targets();
  targets.depth.read_only = true;
  Rasterizer rasterizer;
  auto workers = scene.workers(1);
  const Draw draw = scene.draw();
  rasterizer.draw(targets, {&draw, 1}, workers);
  EXPECT_EQ(depth.count(0.75f), 4096u);
  EXPECT_EQ(target.count(1.0f), 2048u);
}

TEST(RasterDepth, PassesOfDifferentKindsAgree) {  // RAS-63
  for (const auto kind : {testing::TriangleKind::kSmall, testing::TriangleKind::kMedium,
                          testing::TriangleKind::kSliver, testing::TriangleKind::kHuge}) {
    for (const Format format : {Format::kD32Float, Format::kD16Unorm, Format::kD24UnormS8Uint}) {
      Scene scene(230, 190);
      TestTexture& depth = scene.add_depth(format);
      std::mt19937 random(33);
      testing::add_random_triangles(scene, kind, 400, random);
      scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kGreater;
      scene.run();
      const std::vector<uint8_t> before = depth.bytes();
      // Shaded, with other targets, in scissor rectangles, with z in the shader.
      TestTexture& target = scene.add_target(Format::kR32Float);
      scene.add_target(Format::kR8G8B8A8Unorm);
      scene.add_pixel_input(scene.linked.pixel_columns.position, 4);
      scene.shade_constant(1, 1, 1, 1);
      scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kEqual;
      for (const rtapi::Rect& rect : {rtapi::Rect{0, 0, 77, 190}, rtapi::Rect{77, 0, 230, 99},
                                      rtapi::Rect{77, 99, 230, 190}}) {
        scene.state.scissors[0] = rect;
        scene.run();
      }
      EXPECT_EQ(depth.bytes(), before);
      uint32_t missed = 0;
      for (uint32_t y = 0; y < 190; ++y) {
        for (uint32_t x = 0; x < 230; ++x) {
          const bool drawn = format == Format::kD16Unorm ? depth.at<uint16_t>(x, y) != 0
                                                         : depth.at<uint32_t>(x, y) != 0;
          missed += drawn != (target.at<float>(x, y) == 1.0f) ? 1 : 0;
        }
      }
      EXPECT_EQ(missed, 0u);
    }
  }
}

TEST(RasterDepth, BiasOfFloatDepth) {  // RAS-64
  const auto stored = [](float z, int32_t bias) {
    Scene scene(64, 64);
    TestTexture& depth = scene.add_depth(Format::kD32Float);
    scene.linked.rasterizer.DepthBias = bias;
    scene.quad_px(0, 0, 64, 64, z);
    scene.run();
    return depth.at<uint32_t>(20, 30);
  };
  EXPECT_EQ(stored(1.0f / 64, 1), 0x3C800001u);
  EXPECT_EQ(stored(0.5f, 2), 0x3F000002u);
  EXPECT_EQ(stored(0.5f, -1), 0x3EFFFFFEu);  // a unit of 0.5 is two below it
  Scene scene;
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  scene.linked.rasterizer.SlopeScaledDepthBias = 2;
  add_slope(scene, 0, 0.5f);
  scene.run();
  for (uint32_t x = 0; x < 256; ++x) {
    EXPECT_EQ(depth.at<float>(x, 77), (static_cast<float>(x) + 0.5f) / 512 + 1.0f / 256);
  }
}

TEST(RasterDepth, BiasOfUnormDepth) {  // RAS-65
  const auto passes = [](Format format, uint32_t clear, int32_t bias) {
    Scene scene(64, 64);
    TestTexture& target = scene.add_target(Format::kR32Float);
    scene.add_depth(format);
    scene.quad_px(0, 0, 64, 64, as_float(clear));
    scene.run();
    scene.clear_vertices();
    scene.shade_constant(1, 1, 1, 1);
    scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kGreaterEqual;
    scene.linked.rasterizer.DepthBias = bias;
    scene.quad_px(0, 0, 64, 64, as_float(0x3C800000));
    scene.run();
    return target.count(1.0f) == 4096u;
  };
  EXPECT_FALSE(passes(Format::kD16Unorm, 0x3C802000, 0));
  EXPECT_TRUE(passes(Format::kD16Unorm, 0x3C802000, 1));
  EXPECT_FALSE(passes(Format::kD16Unorm, 0x3C820000, 1));
  EXPECT_FALSE(passes(Format::kD24UnormS8Uint, 0x3C800020, 0));
  EXPECT_TRUE(passes(Format::kD24UnormS8Uint, 0x3C800020, 1));
}

TEST(RasterDepth, BiasIsSeenByShaders) {  // RAS-66, RAS-68
  Scene scene(64, 64);
  scene.linked.rasterizer.DepthBias = 1;
  scene.quad_px(0, 0, 64, 64, 0.5f);
  EXPECT_EQ(position_z(scene), 0x3F000001u);
  Scene disabled(64, 64);
  disabled.add_depth(Format::kD16Unorm);
  disabled.linked.depth_stencil.DepthEnable = false;
  disabled.linked.rasterizer.DepthBias = 655;
  disabled.quad_px(0, 0, 64, 64, 0.5f);
  EXPECT_EQ(position_z(disabled), as_bits(0.5f + 655.0f * (1.0f / 65535.0f)));
}

TEST(RasterDepth, BiasIsClamped) {  // RAS-67
  const auto biased = [](float bias, float clamp) {
    Scene scene(64, 64);
    scene.linked.rasterizer.SlopeScaledDepthBias = bias > 0 ? 1.0f : -1.0f;
    scene.linked.rasterizer.DepthBiasClamp = clamp;
    // The slope is |bias| per pixel along x; z at pixel 7 is known.
    add_slope(scene, 0.25f, 0.25f + std::fabs(bias) * 64);
    return as_float(position_z(scene)) - (0.25f + 7.5f * std::fabs(bias));
  };
  EXPECT_NEAR(biased(0x1p-7f, 0x1p-10f), 0x1p-10f, 1e-7f);
  EXPECT_NEAR(biased(-0x1p-7f, -0x1p-10f), -0x1p-10f, 1e-7f);
  EXPECT_NEAR(biased(-0x1p-7f, 0x1p-10f), -0x1p-7f, 1e-7f);
  EXPECT_NEAR(biased(0x1p-7f, 0), 0x1p-7f, 1e-7f);
}

TEST(RasterDepth, BiasedDepthIsNotClipped) {  // RAS-68
  Scene scene(64, 64);
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  depth.fill(0.5f);
  scene.linked.rasterizer.DepthBias = 1 << 22;
  scene.quad_px(0, 0, 64, 64, 1.0f);
  scene.run();
  EXPECT_EQ(depth.count(1.0f), 4096u);
}

}  // namespace
}  // namespace kaamos::raster
