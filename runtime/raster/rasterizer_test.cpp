// SPDX-License-Identifier: MIT
//
// Order of draws and triangles, when depth is tested, and that threads and batches do not matter:
// RAS-98 to RAS-103, RAS-149.
#include "runtime/raster/rasterizer.h"

#include <gtest/gtest.h>

#include <atomic>

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

// Blending in the order of drawing, as a serial reference does. [RAS-98]
TEST(Rasterizer, BlendsInOrder) {
  constexpr uint32_t kSize = 128;
  constexpr uint32_t kTriangles = 2000;
  for (const uint32_t threads : {1u, 8u}) {
    Scene scene(kSize, kSize, 1);
    TestTexture& target = scene.add_target(Format::kR32Float);
    const uint32_t value = scene.add_varying(4, 1, shader::Interpolation::kNoInterpolation);
    scene.shade([&](shader::PixelLanes& lanes) {
      for (int i = 0; i < 8; ++i) {
        lanes.outputs[0][i] = lanes.inputs[value][i];
        lanes.outputs[3][i] = as_bits(0.25f);
      }
    });
    auto& blend = scene.linked.blend[0];
    blend.BlendEnable = true;
    blend.SrcBlend = rtapi::Blend::kSrcAlpha;
    blend.DestBlend = rtapi::Blend::kInvSrcAlpha;
    std::mt19937 random(4);
    testing::add_random_triangles(scene, testing::TriangleKind::kMedium, kTriangles, random);
    for (size_t i = 4; i < scene.floats.size(); i += 5) {
      scene.floats[i] = static_cast<float>(i % 1000) / 64;
    }
    scene.run(threads, {.batch_triangles = 100});
    std::vector<float> expected(kSize * kSize);
    for (uint32_t i = 0; i < kTriangles; ++i) {
      const testing::ReferenceTriangle triangle(testing::corners_of(scene, i).v,
                                                scene.state.viewports[0]);
      for (uint32_t y = 0; y < kSize; ++y) {
        for (uint32_t x = 0; x < kSize; ++x) {
          if (!triangle.covers(static_cast<int32_t>(x), static_cast<int32_t>(y))) continue;
          float& pixel = expected[y * kSize + x];
          const float source = scene.floats[i * 15 + 4] * 0.25f;
          pixel = source + pixel * 0.75f;
        }
      }
    }
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) {
        ASSERT_EQ(target.at<float>(x, y), expected[y * kSize + x]) << x << ' ' << y;
      }
    }
  }
}

TEST(Rasterizer, TestsSeeEarlierTriangles) {  // RAS-101
  for (const uint32_t flags :
       {0u, uint32_t{shader::kGraphicsWritesMemory}, uint32_t{shader::kGraphicsDiscards}}) {
    Scene scene(64, 64);
    TestTexture& target = scene.add_target(Format::kR32Uint);
    scene.add_depth(Format::kD32Float).fill(1.0f);
    scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kLess;
    const uint32_t id = scene.add_pixel_input(scene.linked.pixel_columns.primitive_id);
    scene.shade(
        [&](shader::PixelLanes& lanes) {
          for (int i = 0; i < 8; ++i) lanes.outputs[0][i] = 1 + lanes.inputs[id][i];
        },
        flags);
    for (int i = 0; i < 5; ++i) scene.triangle_px(-64, 0, 128, 0, 32, 200);
    scene.run();
    EXPECT_EQ(target.count(1u), 4096u) << flags;
  }
}

// Counts pixels that the shader runs for, with everything hidden or not.
struct CountedScene : Scene {
  explicit CountedScene(uint32_t flags, float stored, bool discards = false) : Scene(64, 64) {
    add_target(Format::kR32Float);
    add_depth(Format::kD32Float).fill(stored);
    linked.depth_stencil.DepthFunc = ComparisonFunc::kLess;
    shade(
        [this, discards](shader::PixelLanes& lanes) {
          pixels += static_cast<uint32_t>(__builtin_popcount(lanes.live));
          for (uint32_t& lane : lanes.outputs[0]) lane = as_bits(1);
          if (discards) lanes.live = 0;
        },
        flags);
    quad_px(0, 0, 64, 64, 0.5f);
    run();
  }
  std::atomic<uint32_t> pixels{0};
};

TEST(Rasterizer, StoresMakeTheTestLate) {  // RAS-99
  CountedScene late(shader::kGraphicsWritesMemory, 0.25f);
  EXPECT_EQ(late.pixels, 4096u);
  EXPECT_EQ(late.color[0]->count(1.0f), 0u);
  CountedScene ordered(shader::kGraphicsOrdersPixels, 0.25f);
  EXPECT_EQ(ordered.pixels, 4096u);
  CountedScene plain(0, 0.25f);
  EXPECT_EQ(plain.pixels, 0u);
  CountedScene seen(shader::kGraphicsWritesMemory, 0.75f);
  EXPECT_EQ(seen.color[0]->count(1.0f), 4096u);
  EXPECT_EQ(seen.depth->count(0.5f), 4096u);
}

TEST(Rasterizer, EarlyTestsWriteBeforeTheShader) {  // RAS-100
  constexpr uint32_t kFlags = shader::kGraphicsEarlyDepthStencil | shader::kGraphicsDiscards |
                              shader::kGraphicsWritesMemory;
  CountedScene discarded(kFlags, 0.75f, true);
  EXPECT_EQ(discarded.pixels, 4096u);
  EXPECT_EQ(discarded.depth->count(0.5f), 4096u);
  EXPECT_EQ(discarded.color[0]->count(0.0f), 4096u);
  CountedScene hidden(kFlags, 0.25f, true);
  EXPECT_EQ(hidden.pixels, 0u);
  CountedScene late(shader::kGraphicsDiscards, 0.75f, true);
  EXPECT_EQ(late.depth->count(0.75f), 4096u);
}

TEST(Rasterizer, EarlyTestsIgnoreTheDepthOfTheShader) {  // RAS-100
  for (const bool early : {false, true}) {
    Scene scene(64, 64);
    TestTexture& depth = scene.add_depth(Format::kD24UnormS8Uint);
    const uint32_t column = scene.depth_output();
    scene.shade(
        [&](shader::PixelLanes& lanes) {
          for (uint32_t& lane : lanes.outputs[column]) lane = as_bits(1.0f);
        },
        early ? uint32_t{shader::kGraphicsEarlyDepthStencil} : 0u);
    scene.quad_px(0, 0, 64, 64, 0.5f);
    scene.run();
    EXPECT_EQ(depth.count(early ? 0x800000u : 0xFFFFFFu), 4096u);
  }
}

TEST(Rasterizer, PixelsOfOnePlaceRunInOrder) {  // RAS-103
  constexpr uint32_t kSize = 100;
  std::vector<uint32_t> values(kSize * kSize);
  Scene scene(kSize, kSize);
  scene.add_target(Format::kR8Unorm);
  const uint32_t position = scene.add_pixel_input(scene.linked.pixel_columns.position, 2);
  const uint32_t id = scene.add_pixel_input(scene.linked.pixel_columns.primitive_id);
  scene.shade(
      [&](shader::PixelLanes& lanes) {
        for (int i = 0; i < 8; ++i) {
          if ((lanes.live >> i & 1) == 0) continue;
          const auto x = static_cast<uint32_t>(as_float(lanes.inputs[position][i]));
          const auto y = static_cast<uint32_t>(as_float(lanes.inputs[position + 1][i]));
          uint32_t& value = values[y * kSize + x];
          value = value * 3 + lanes.inputs[id][i];
        }
      },
      shader::kGraphicsOrdersPixels);
  for (int i = 0; i < 50; ++i) scene.triangle_px(-100, 0, 200, 0, 50, 300);
  scene.run(4, {.batch_triangles = 3});
  uint32_t expected = 0;
  for (uint32_t i = 0; i < 50; ++i) expected = expected * 3 + i;
  for (const uint32_t value : values) ASSERT_EQ(value, expected);
}

// All bytes of all targets of several draws with depth, blending and discard.
std::vector<uint8_t> many_draws(uint32_t threads, const RasterizerOptions& options) {
  Scene scene(300, 170, 2);
  scene.add_target(Format::kR8G8B8A8UnormSrgb);
  scene.add_target(Format::kR16G16B16A16Float);
  scene.add_depth(Format::kD24UnormS8Uint).fill(0xFFFFFFu);
  const uint32_t value = scene.add_varying(4, 2);
  const uint32_t position = scene.add_pixel_input(scene.linked.pixel_columns.position, 4);
  std::atomic<uint64_t> sum{0};
  scene.shade(
      [&](shader::PixelLanes& lanes) {
        for (int i = 0; i < 8; ++i) {
          if ((lanes.live >> i & 1) == 0) continue;
          const float z = as_float(lanes.inputs[position + 2][i]);
          const float a = as_float(lanes.inputs[value][i]);
          sum += as_bits(z) + as_bits(a);
          if (a > 0.9f) lanes.live &= ~(1u << i);
          for (uint32_t c = 0; c < 8; ++c) {
            lanes.outputs[c][i] = lanes.inputs[c % 3 == 0 ? position + 2 : value + c % 2][i];
          }
        }
      },
      shader::kGraphicsDiscards);
  scene.linked.depth_stencil.DepthFunc = ComparisonFunc::kLessEqual;
  auto& blend = scene.linked.blend[1];
  blend.BlendEnable = true;
  blend.SrcBlend = rtapi::Blend::kSrcAlpha;
  blend.DestBlend = rtapi::Blend::kInvSrcAlpha;
  std::mt19937 random(14);
  for (const auto kind : {testing::TriangleKind::kSmall, testing::TriangleKind::kMedium,
                          testing::TriangleKind::kSliver, testing::TriangleKind::kHuge}) {
    testing::add_random_triangles(scene, kind, 700, random);
  }
  for (size_t i = 0; i < scene.floats.size(); i += 6) {
    if (i % 13 == 0) scene.floats[i + 3] *= -1;  // behind the eye
    for (size_t c = 4; c < 6; ++c) {
      scene.floats[i + c] = std::uniform_real_distribution<float>(0, 1)(random);
    }
  }
  std::vector<Draw> draws;
  const auto vertices = static_cast<uint32_t>(scene.floats.size() / 6);
  for (uint32_t first = 0; first < vertices; first += 333) {
    Draw draw = scene.draw();
    draw.arguments.StartIndexLocation = first;
    draw.arguments.IndexCountPerInstance = std::min(333u, vertices - first);
    draw.arguments.InstanceCount = 1 + first % 2;
    draws.push_back(draw);
  }
  Rasterizer rasterizer(options);
  auto workers = scene.workers(threads);
  rasterizer.draw(scene.targets(), draws, workers);
  std::vector<uint8_t> bytes = scene.color[0]->bytes();
  bytes.insert(bytes.end(), scene.color[1]->bytes().begin(), scene.color[1]->bytes().end());
  bytes.insert(bytes.end(), scene.depth->bytes().begin(), scene.depth->bytes().end());
  const uint64_t total = sum;
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<uint8_t>(total >> 8 * i));
  return bytes;
}

TEST(Rasterizer, ThreadsAndBatchesDoNotMatter) {  // RAS-149
  const std::vector<uint8_t> expected = many_draws(1, {});
  for (const uint32_t threads : {1u, 2u, 3u, 7u}) {
    for (const uint32_t triangles : {1u, 64u, 4096u}) {
      for (const uint64_t bytes : {uint64_t{1}, uint64_t{100000}, uint64_t{64} << 20}) {
        EXPECT_EQ(many_draws(threads, {triangles, bytes}) == expected, true)
            << threads << ' ' << triangles << ' ' << bytes;
      }
    }
  }
}

TEST(Rasterizer, ProcessorsDoNotMatter) {
  EXPECT_EQ(many_draws(1, {}) == many_draws(1, {.any_processor = true}), true);
}

TEST(Rasterizer, MemoryIsUsedAgain) {
  Rasterizer rasterizer({.batch_triangles = 7});
  std::vector<uint8_t> first;
  for (int round = 0; round < 3; ++round) {
    Scene scene(200, 100);
    TestTexture& target = scene.add_target(Format::kR8G8B8A8Unorm);
    scene.shade_constant(1, 0.5f, 0.25f, 0);
    std::mt19937 random(2);
    testing::add_random_triangles(scene, testing::TriangleKind::kMedium, 100, random);
    auto workers = scene.workers(2);
    const Draw draw = scene.draw();
    rasterizer.draw(scene.targets(), {&draw, 1}, workers);
    if (round == 0) first = target.bytes();
    EXPECT_EQ(target.bytes(), first);
    // Another pass, of another shape, between them.
    Scene other(640, 480);
    other.add_depth(Format::kD32Float);
    other.quad_px(0, 0, 640, 480);
    auto other_workers = other.workers(1);
    const Draw other_draw = other.draw();
    rasterizer.draw(other.targets(), {&other_draw, 1}, other_workers);
    EXPECT_EQ(other.depth->count(0.5f), 640u * 480u);
  }
}

}  // namespace
}  // namespace kaamos::raster
