// SPDX-License-Identifier: MIT
//
// Tests what pixel shaders get: RAS-72 to RAS-81, RAS-84 to RAS-86, RAS-89.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "runtime/raster/testing/random_triangles.h"
#include "runtime/raster/testing/reference.h"
#include "runtime/raster/testing/scene.h"

namespace kaamos::raster {
namespace {

using rtapi::Format;
using shader::Interpolation;
using testing::as_bits;
using testing::as_float;
using testing::Scene;
using testing::TestTexture;

using Float4 = std::array<float, 4>;

TEST(RasterQuads, PerspectiveAndNot) {  // RAS-73
  for (const auto interpolation : {Interpolation::kLinear, Interpolation::kNoPerspective}) {
    Scene scene(256, 256, 1);
    TestTexture& target = scene.add_target(Format::kR32Float);
    scene.shade_columns(scene.add_varying(4, 1, interpolation), 1);
    // w is 1 on the left and 3 on the right, the attribute 0 and 1.
    for (const auto& [x, y] : {std::pair{-1.0f, 1.0f},
                               {1.0f, 1.0f},
                               {-1.0f, -1.0f},
                               {-1.0f, -1.0f},
                               {1.0f, 1.0f},
                               {1.0f, -1.0f}}) {
      const float w = x < 0 ? 1 : 3;
      scene.vertex(x * w, y * w, 0.5f * w, w, {x < 0 ? 0.0f : 1.0f});
    }
    scene.run();
    const bool linear = interpolation == Interpolation::kLinear;
    for (uint32_t x = 0; x < 256; ++x) {
      const double t = (x + 0.5) / 256;
      const double expected = linear ? t / 3 / ((1 - t) + t / 3) : t;
      ASSERT_NEAR(static_cast<double>(target.at<float>(x, 100)), expected, 0x1p-20) << x;
    }
  }
}

// Attributes, barycentrics and w of random triangles. [RAS-72, RAS-73, RAS-77]
TEST(RasterQuads, RandomTriangles) {
  std::mt19937 random(77);
  constexpr uint32_t kSize = 128;
  for (const auto kind : {testing::TriangleKind::kSmall, testing::TriangleKind::kMedium}) {
    for (uint32_t i = 0; i < testing::random_triangle_count() / 10; ++i) {
      Scene scene(kSize, kSize, 1);
      TestTexture& first = scene.add_target(Format::kR32G32B32A32Float);
      TestTexture& second = scene.add_target(Format::kR32G32B32A32Float);
      const bool no_perspective = i % 2 == 1;
      const uint32_t linear = scene.add_varying(4, 1);
      const uint32_t screen = scene.add_varying(4, 1, Interpolation::kNoPerspective);
      const uint32_t position = scene.add_pixel_input(scene.linked.pixel_columns.position, 4);
      const uint32_t weights = scene.add_pixel_input(scene.linked.pixel_columns.barycentrics, 3);
      scene.linked.pixel_columns.barycentrics_no_perspective = no_perspective;
      scene.shade([&](shader::PixelLanes& lanes) {
        const uint32_t from[8] = {linear,  screen,      position,    position + 3,
                                  weights, weights + 1, weights + 2, position + 1};
        for (int lane = 0; lane < 8; ++lane) {
          for (uint32_t c = 0; c < 8; ++c) lanes.outputs[c][lane] = lanes.inputs[from[c]][lane];
        }
      });
      testing::add_random_triangles(scene, kind, 1, random);
      float values[3];
      for (uint32_t v = 0; v < 3; ++v) {
        values[v] = std::uniform_real_distribution<float>(-2, 2)(random);
        scene.floats[v * 5 + 4] = values[v];
      }
      scene.run();
      const testing::ReferenceTriangle triangle(testing::corners_of(scene, 0).v,
                                                scene.state.viewports[0]);
      for (uint32_t y = 0; y < kSize; ++y) {
        for (uint32_t x = 0; x < kSize; ++x) {
          const auto px = static_cast<int32_t>(x), py = static_cast<int32_t>(y);
          if (!triangle.covers(px, py)) continue;
          long double perspective[3], on_screen[3];
          triangle.weights(px, py, true, perspective);
          triangle.weights(px, py, false, on_screen);
          long double expected[2] = {}, inv_w = 0;
          for (int v = 0; v < 3; ++v) {
            expected[0] += perspective[v] * static_cast<long double>(values[v]);
            expected[1] += on_screen[v] * static_cast<long double>(values[v]);
            inv_w += on_screen[v] / static_cast<long double>(scene.floats[v * 5 + 3]);
          }
          const auto got = first.at<Float4>(x, y);
          const auto more = second.at<Float4>(x, y);
          constexpr double kTolerance = 0x1p-20;
          ASSERT_NEAR(static_cast<double>(got[0]), static_cast<double>(expected[0]), kTolerance);
          ASSERT_NEAR(static_cast<double>(got[1]), static_cast<double>(expected[1]), kTolerance);
          ASSERT_EQ(got[2], static_cast<float>(x) + 0.5f);
          ASSERT_NEAR(static_cast<double>(got[3]) * static_cast<double>(inv_w), 1, 0x1p-21);
          ASSERT_EQ(more[3], static_cast<float>(y) + 0.5f);
          for (size_t v = 0; v < 3; ++v) {
            ASSERT_NEAR(static_cast<double>(more[v]),
                        static_cast<double>(no_perspective ? on_screen[v] : perspective[v]),
                        kTolerance);
          }
        }
      }
    }
  }
}

TEST(RasterQuads, ConstantsAreExact) {  // RAS-75
  std::mt19937 random(78);
  Scene scene(200, 200, 1);
  TestTexture& target = scene.add_target(Format::kR32Float);
  scene.shade_columns(scene.add_varying(4, 1), 1);
  for (const auto kind : {testing::TriangleKind::kSmall, testing::TriangleKind::kMedium,
                          testing::TriangleKind::kSliver}) {
    testing::add_random_triangles(scene, kind, 1000, random);
  }
  for (size_t i = 4; i < scene.floats.size(); i += 5) scene.floats[i] = 0.1f;
  scene.run();
  EXPECT_GT(target.count(0.1f), 30000u);
  EXPECT_EQ(target.count(0.1f) + target.count(0.0f), 40000u);
}

TEST(RasterQuads, WIsExactIfConstant) {  // RAS-77
  Scene scene(64, 64);
  TestTexture& target = scene.add_target(Format::kR32G32B32A32Float);
  scene.shade_columns(scene.add_pixel_input(scene.linked.pixel_columns.position, 4), 4);
  scene.quad(-5, 5, 5, -5, 2.5f, 5);
  scene.run();
  const auto texel = target.at<Float4>(3, 7);
  EXPECT_EQ(texel[0], 3.5f);
  EXPECT_EQ(texel[1], 7.5f);
  EXPECT_EQ(texel[2], 0.5f);
  EXPECT_NEAR(texel[3], 5.0f, 5.0f * 0x1p-23f);
}

TEST(RasterQuads, ClippedTrianglesKeepTheirNumber) {  // RAS-78
  Scene scene;
  TestTexture& target = scene.add_target(Format::kR32Uint);
  const uint32_t id = scene.add_pixel_input(scene.linked.pixel_columns.primitive_id);
  scene.shade([&](shader::PixelLanes& lanes) {
    for (int i = 0; i < 8; ++i) lanes.outputs[0][i] = lanes.inputs[id][i] + 1;
  });
  for (const auto& [x, y] : {std::pair{-1.0f, 1.0f},
                             {1.0f, 1.0f},
                             {-1.0f, -1.0f},
                             {-1.0f, -1.0f},
                             {1.0f, 1.0f},
                             {1.0f, -1.0f}}) {
    scene.vertex(x, y, x + 0.5f, 1);
  }
  scene.run();
  EXPECT_GT(target.count(1u), 15000u);
  EXPECT_EQ(target.count(1u) + target.count(2u), 128u * 256u);
}

TEST(RasterQuads, ClippedBarycentricsAreOfTheWholeTriangle) {  // RAS-72
  for (const bool swapped : {false, true}) {
    Scene scene(256, 256, 1);
    TestTexture& target = scene.add_target(Format::kR32G32B32A32Float);
    const uint32_t weights = scene.add_pixel_input(scene.linked.pixel_columns.barycentrics, 3);
    scene.add_varying(4, 1);
    scene.shade_columns(weights, 4);
    scene.vertex(-1, 1, -0.5f, 1, {3});
    const auto second = [&] { scene.vertex(2, 2, 1, 2, {5}); };
    const auto third = [&] { scene.vertex(-3, -3, 0.5f, 3, {9}); };
    if (swapped) {
      third();
      second();
    } else {
      second();
      third();
    }
    scene.run();
    uint32_t covered = 0;
    for (uint32_t y = 0; y < 256; ++y) {
      for (uint32_t x = 0; x < 256; ++x) {
        const auto texel = target.at<Float4>(x, y);
        if (texel[3] == 0) continue;
        ++covered;
        const float expected =
            3 * texel[0] + (swapped ? 9 : 5) * texel[1] + (swapped ? 5 : 9) * texel[2];
        ASSERT_NEAR(texel[3], expected, 1e-5f);
        ASSERT_NEAR(texel[0] + texel[1] + texel[2], 1, 1e-6f);
      }
    }
    EXPECT_GT(covered, 10000u);
  }
}

TEST(RasterQuads, HelpersExtrapolate) {  // RAS-81, RAS-84, RAS-85
  Scene scene(64, 64, 1);
  TestTexture& target = scene.add_target(Format::kR32G32B32A32Float);
  const uint32_t value = scene.add_varying(4, 1, Interpolation::kNoPerspective);
  const uint32_t position = scene.add_pixel_input(scene.linked.pixel_columns.position, 2);
  std::atomic<uint32_t> live{0};
  scene.shade([&](shader::PixelLanes& lanes) {
    live += static_cast<uint32_t>(__builtin_popcount(lanes.live));
    EXPECT_EQ(lanes.live & ~lanes.active, 0u);
    for (int i = 0; i < 8; ++i) {
      const auto in = [&](uint32_t column, int lane) {
        return as_float(lanes.inputs[column][lane]);
      };
      lanes.outputs[0][i] = as_bits(in(position, i | 1) - in(position, i & ~1));
      lanes.outputs[1][i] = as_bits(in(position + 1, i | 2) - in(position + 1, i & ~2));
      lanes.outputs[2][i] = as_bits(in(value, i | 1) - in(value, i & ~1));
      lanes.outputs[3][i] = as_bits(in(value, i | 2) - in(value, i & ~2));
    }
  });
  // One pixel, at an odd place.
  const auto attribute = [](float x, float y) { return 3 * x - 2 * y; };
  for (const auto& [x, y] : {std::pair{10.6f, 21.25f},
                             {11.875f, 21.4f},
                             {11.1f, 21.9f},
                             {30.0f, 30.0f},
                             {41.0f, 33.0f},
                             {29.0f, 47.0f}}) {
    scene.vertex_px(x, y, 0.5f, {attribute(x, y)});
  }
  scene.run();
  const auto one = target.at<Float4>(11, 21);
  EXPECT_EQ(one[0], 1.0f);
  EXPECT_EQ(one[1], 1.0f);
  uint32_t covered = 0;
  for (uint32_t y = 0; y < 64; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      const auto texel = target.at<Float4>(x, y);
      if (texel[0] == 0) continue;
      ++covered;
      // Snapping moves the one-pixel triangle's corners, but not its values.
      const float tolerance = y < 25 ? 0.05f : 0.01f;
      EXPECT_NEAR(texel[2], 3, tolerance);
      EXPECT_NEAR(texel[3], -2, tolerance);
    }
  }
  EXPECT_EQ(covered, live);
}

TEST(RasterQuads, DiscardedPixelsWriteNothing) {  // RAS-86
  Scene scene(64, 64);
  TestTexture& target = scene.add_target(Format::kR32Float);
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  const uint32_t position = scene.add_pixel_input(scene.linked.pixel_columns.position, 2);
  scene.shade(
      [&](shader::PixelLanes& lanes) {
        for (int i = 0; i < 8; ++i) {
          const auto x = static_cast<uint32_t>(as_float(lanes.inputs[position][i]));
          const auto y = static_cast<uint32_t>(as_float(lanes.inputs[position + 1][i]));
          if ((x + y) % 2 == 0) lanes.live &= ~(1u << i);
          lanes.outputs[0][i] = as_bits(1);
        }
      },
      shader::kGraphicsDiscards);
  scene.quad_px(0, 0, 64, 64, 0.5f);
  scene.run();
  for (uint32_t y = 0; y < 64; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      const bool drawn = (x + y) % 2 != 0;
      ASSERT_EQ(target.at<float>(x, y), drawn ? 1.0f : 0.0f);
      ASSERT_EQ(depth.at<float>(x, y), drawn ? 0.5f : 0.0f);
    }
  }
}

TEST(RasterQuads, HiddenPixelsAreHelpers) {  // RAS-89
  Scene scene(64, 64);
  scene.add_target(Format::kR32Float);
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  for (uint32_t y = 0; y < 64; ++y) {
    for (uint32_t x = 0; x < 64; ++x) depth.set(x, y, x % 2 == 0 ? 0.25f : 0.75f);
  }
  scene.linked.depth_stencil.DepthFunc = rtapi::ComparisonFunc::kLess;
  scene.shade([&](shader::PixelLanes& lanes) {
    EXPECT_EQ(lanes.active, 0xFFu);
    EXPECT_EQ(lanes.live, 0xAAu);
  });
  scene.quad_px(0, 0, 64, 64, 0.5f);
  scene.run();
  EXPECT_EQ(depth.count(0.5f), 2048u);
}

}  // namespace
}  // namespace kaamos::raster
