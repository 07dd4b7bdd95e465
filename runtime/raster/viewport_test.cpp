// SPDX-License-Identifier: MIT
//
// Viewports, scissor rectangles and array slices: RAS-37 to RAS-46.
#include "runtime/raster/viewport.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "runtime/raster/testing/scene.h"

namespace kaamos::raster {
namespace {

using rtapi::Format;
using testing::Scene;
using testing::TestTexture;

struct ColorScene : Scene {
  explicit ColorScene(uint32_t attributes = 0)
      : Scene(256, 256, attributes), target(add_target(Format::kR32Float)) {
    shade_constant(1, 0, 0, 0);
  }
  uint32_t covered() { return target.count(1.0f); }
  TestTexture& target;
};

TEST(RasterViewport, YPointsDown) {  // RAS-37
  ColorScene scene;
  scene.quad(-1, 1, 1, 0, 0.5f);
  scene.run();
  for (uint32_t y = 0; y < 256; ++y) {
    ASSERT_EQ(scene.target.at<float>(5, y), y < 128 ? 1.0f : 0.0f) << y;
  }
}

TEST(RasterViewport, FractionsShift) {  // RAS-38
  ColorScene scene;
  scene.state.viewports[0] = {0.25f, 0, 256, 256, 0, 1};
  scene.quad_px(10, 10, 20, 20);
  scene.run();
  EXPECT_EQ(scene.covered(), 100u);
  EXPECT_EQ(scene.target.at<float>(10, 10), 1.0f);
  scene.target.fill(0.0f);
  scene.state.viewports[0].TopLeftX = 0.75f;
  scene.run();
  EXPECT_EQ(scene.target.at<float>(10, 10), 0.0f);
  EXPECT_EQ(scene.target.at<float>(20, 10), 1.0f);
}

TEST(RasterViewport, LimitsPrimitives) {  // RAS-39
  ColorScene scene;
  scene.state.viewports[0] = {64, 64, 128, 128, 0, 1};
  scene.quad(-2, 2, 2, -2, 0.5f);
  scene.run();
  EXPECT_EQ(scene.covered(), 16384u);
  EXPECT_EQ(scene.target.at<float>(64, 64), 1.0f);
  EXPECT_EQ(scene.target.at<float>(191, 191), 1.0f);
}

TEST(RasterViewport, BothMustBeSet) {  // RAS-40
  for (const auto& [viewports, scissors] : {std::pair{0u, 1u}, {1u, 0u}}) {
    ColorScene scene;
    scene.state.viewport_count = viewports;
    scene.state.scissor_count = scissors;
    scene.quad(-1, 1, 1, -1, 0.5f);
    scene.run();
    EXPECT_EQ(scene.covered(), 0u);
  }
}

TEST(RasterViewport, Scissor) {  // RAS-41
  const auto covered = [](rtapi::Rect rect) {
    ColorScene scene;
    scene.state.scissors[0] = rect;
    scene.quad(-1, 1, 1, -1, 0.5f);
    scene.run();
    EXPECT_TRUE(scene.target.padding_is_intact());
    return scene.covered();
  };
  EXPECT_EQ(covered({10, 10, 20, 20}), 100u);
  EXPECT_EQ(covered({-5, -7, 3, 3}), 9u);
  EXPECT_EQ(covered({250, 250, 1000, 1000}), 36u);
  EXPECT_EQ(covered({20, 20, 10, 30}), 0u);
  EXPECT_EQ(covered({10, 10, 10, 30}), 0u);
  EXPECT_EQ(covered({5, 3, 6, 4}), 1u);
}

TEST(RasterViewport, DepthIsClampedToItsRange) {  // RAS-42, RAS-69
  const auto stored = [](float value) {
    Scene scene(64, 64);
    TestTexture& depth = scene.add_depth(Format::kD32Float);
    depth.fill(0.125f);
    scene.state.viewports[0].MinDepth = 0.25f;
    scene.state.viewports[0].MaxDepth = 0.5f;
    const uint32_t column = scene.depth_output();
    scene.shade([&](shader::PixelLanes& lanes) {
      for (uint32_t& lane : lanes.outputs[column]) lane = testing::as_bits(value);
    });
    scene.quad_px(0, 0, 64, 64);
    scene.run();
    EXPECT_EQ(depth.count(depth.at<float>(3, 3)), 64u * 64u);
    return depth.at<float>(3, 3);
  };
  EXPECT_EQ(stored(0.9f), 0.5f);
  EXPECT_EQ(stored(0.1f), 0.25f);
  EXPECT_EQ(stored(0.375f), 0.375f);
  EXPECT_EQ(stored(std::numeric_limits<float>::quiet_NaN()), 0.25f);
  EXPECT_EQ(stored(std::numeric_limits<float>::infinity()), 0.5f);
}

TEST(RasterViewport, MayBeUpsideDown) {  // RAS-43
  Scene scene(256, 256);
  TestTexture& target = scene.add_target(Format::kR32Uint);
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  const uint32_t face = scene.add_pixel_input(scene.linked.pixel_columns.is_front_face);
  scene.shade([&](shader::PixelLanes& lanes) {
    for (int i = 0; i < 8; ++i) lanes.outputs[0][i] = 1 + lanes.inputs[face][i];
  });
  scene.state.viewports[0] = {0, 256, 256, -256, 1, 0};
  scene.triangle_px(0, 0, 100, 0, 0, 100, 0.25f);
  scene.run();
  EXPECT_EQ(target.at<uint32_t>(2, 253), 1u);
  EXPECT_EQ(target.at<uint32_t>(2, 2), 0u);
  EXPECT_EQ(depth.at<float>(2, 253), 0.75f);
}

TEST(RasterViewport, WithoutSizeNothingIsDrawn) {  // RAS-44
  for (const auto& [width, height] : {std::pair{0.0f, 256.0f},
                                      {-256.0f, 256.0f},
                                      {256.0f, 0.0f},
                                      {std::numeric_limits<float>::quiet_NaN(), 256.0f}}) {
    ColorScene scene;
    scene.state.viewports[0] = {0, 0, width, height, 0, 1};
    scene.quad(-1, 1, 1, -1, 0.5f);
    scene.run();
    EXPECT_EQ(scene.covered(), 0u);
  }
}

TEST(RasterViewport, LeadingVertexPicks) {  // RAS-45
  Scene scene(256, 256, 1);
  TestTexture& target = scene.add_target(Format::kR32Uint);
  scene.linked.vertex_columns.viewport_array_index = 4;
  scene.shade_columns(scene.add_varying(4, 1, shader::Interpolation::kNoInterpolation), 1);
  for (uint32_t i = 0; i < 4; ++i) {
    scene.state.viewports[i] = {static_cast<float>(i) * 64, 0, 64, 64, 0, 1};
    scene.state.scissors[i] = {0, 0, 256, 256};
  }
  scene.state.viewport_count = scene.state.scissor_count = 4;
  for (const uint32_t number : {1u, 3u, 4u, 16u}) {
    target.fill(0u);
    scene.clear_vertices();
    const float index = testing::as_float(number);
    scene.vertex(-1, 1, 0.5f, 1, {index});
    scene.vertex(3, 1, 0.5f, 1, {testing::as_float(2)});
    scene.vertex(-1, -3, 0.5f, 1, {testing::as_float(2)});
    scene.run();
    const uint32_t used = number == 16 ? 0 : number;
    EXPECT_EQ(target.count(number), used == 4 ? 0u : 64u * 64u) << number;
    if (used != 4) {
      EXPECT_EQ(target.at<uint32_t>(used * 64, 0), number);
    }
  }
}

TEST(RasterViewport, LeadingVertexPicksTheSlice) {  // RAS-46
  Scene scene(128, 128, 1);
  TestTexture& target = scene.add_target(Format::kR32Uint, 6);
  TestTexture& depth = scene.add_depth(Format::kD16Unorm, 6);
  scene.linked.vertex_columns.target_array_index = 4;
  scene.shade_columns(scene.add_varying(4, 1, shader::Interpolation::kNoInterpolation), 1);
  for (const uint32_t slice : {5u, 1u, 3u, 4u, 2u, 7u}) {
    const float index = testing::as_float(slice);
    scene.vertex(-1, 1, 0.5f, 1, {index});
    scene.vertex(3, 1, 0.5f, 1);
    scene.vertex(-1, -3, 0.5f, 1);
  }
  scene.run(2);
  for (uint32_t slice = 0; slice < 6; ++slice) {
    for (uint32_t y = 0; y < 128; ++y) {
      for (uint32_t x = 0; x < 128; ++x) {
        ASSERT_EQ(target.at<uint32_t>(x, y, slice), slice == 0 ? 7u : slice);
        ASSERT_EQ(depth.at<uint16_t>(x, y, slice), 32768u);
      }
    }
  }
  EXPECT_TRUE(target.padding_is_intact());
  EXPECT_TRUE(depth.padding_is_intact());
}

TEST(RasterViewport, WithoutTargetsTheViewportIsTheBound) {  // RAS-106
  Scene scene(256, 256);
  std::atomic<uint32_t> pixels{0};
  scene.shade(
      [&](shader::PixelLanes& lanes) {
        pixels += static_cast<uint32_t>(__builtin_popcount(lanes.live));
      },
      shader::kGraphicsWritesMemory);
  scene.state.viewports[0] = {0, 0, 2, 2, 0, 1};
  scene.quad(-1, 1, 1, -1, 0.5f);
  scene.run();
  EXPECT_EQ(pixels, 4u);
  pixels = 0;
  scene.state.viewports[0] = {16000, 16300, 384, 84, 0, 1};
  scene.run(2);
  EXPECT_EQ(pixels, 384u * 84u);
}

TEST(RasterViewport, TargetsShareTheCommonArea) {  // RAS-129
  Scene scene(64, 64);
  TestTexture& target = scene.add_target(Format::kR32Float);
  scene.depth = std::make_unique<TestTexture>(Format::kD32Float, 32, 40);
  scene.shade_constant(1, 1, 1, 1);
  scene.quad_px(0, 0, 64, 64);
  scene.run();
  EXPECT_EQ(target.count(1.0f), 32u * 40u);
  EXPECT_TRUE(scene.depth->padding_is_intact());
}

}  // namespace
}  // namespace kaamos::raster
