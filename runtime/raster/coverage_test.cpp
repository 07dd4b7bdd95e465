// SPDX-License-Identifier: MIT
//
// Snapping, coverage and facing: RAS-47 to RAS-55.
#include "runtime/raster/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "runtime/raster/screen.h"
#include "runtime/raster/testing/random_triangles.h"
#include "runtime/raster/testing/reference.h"
#include "runtime/raster/testing/scene.h"

namespace kaamos::raster {
namespace {

using rtapi::Format;
using testing::Scene;
using testing::TestTexture;

// A scene that adds 1 to each pixel that it covers.
struct CountingScene : Scene {
  explicit CountingScene(uint32_t size = 256)
      : Scene(size, size), counts(add_target(Format::kR32Float)) {
    auto& blend = linked.blend[0];
    blend.BlendEnable = true;
    blend.SrcBlend = blend.DestBlend = rtapi::Blend::kOne;
    shade_constant(1, 1, 1, 1);
  }
  TestTexture& counts;
};

TEST(Raster, SnapsToNearestEven) {  // RAS-47, RAS-48
  EXPECT_EQ(snap(10.5f), 10 * 256 + 128);
  EXPECT_EQ(snap(10.5f + 1.0f / 512), 10 * 256 + 128);
  EXPECT_EQ(snap(10.5f + 3.0f / 1024), 10 * 256 + 129);
  EXPECT_EQ(snap(10.5f + 3.0f / 512), 10 * 256 + 130);
  EXPECT_EQ(snap(-10.5f - 3.0f / 512), -10 * 256 - 130);
  EXPECT_EQ(snap(24000.0f + 1.0f / 512), 24000 * 256);
  EXPECT_EQ(snap(std::nanf("")), 0);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(snap(kInfinity), 24576 * 256);
  EXPECT_EQ(snap(-kInfinity), -8192 * 256);
  EXPECT_EQ(snap(1e30f), 24576 * 256);
  EXPECT_EQ(snap(10.5 + 3.0 / 512), 10 * 256 + 130);
}

TEST(Raster, SnappedEdgesDecide) {  // RAS-47
  for (const auto& [left, covered] :
       {std::pair{10.5f, 1u}, {10.5f + 1.0f / 512, 1u}, {10.5f + 3.0f / 1024, 0u}}) {
    CountingScene scene;
    scene.quad_px(left, 10, 20, 11);
    scene.run();
    EXPECT_EQ(scene.counts.at<float>(10, 10), static_cast<float>(covered)) << left;
    EXPECT_EQ(scene.counts.at<float>(11, 10), 1.0f);
  }
}

TEST(Raster, TopAndLeftEdgesBelongToTheRectangle) {  // RAS-49
  CountingScene scene;
  scene.quad_px(0.5f, 0.5f, 4.5f, 4.5f);
  scene.run();
  for (uint32_t y = 0; y < 8; ++y) {
    for (uint32_t x = 0; x < 8; ++x) {
      EXPECT_EQ(scene.counts.at<float>(x, y), x < 4 && y < 4 ? 1.0f : 0.0f) << x << ' ' << y;
    }
  }
  EXPECT_EQ(scene.counts.count(1.0f), 16u);
  EXPECT_TRUE(scene.counts.padding_is_intact());
}

TEST(Raster, FanAroundAPixelCenterCoversEachPixelOnce) {  // RAS-50
  CountingScene scene;
  constexpr int kTriangles = 1000;
  const auto corner = [](int i) {
    const double angle = 2 * 3.14159265358979323846 * (i % kTriangles) / kTriangles;
    return std::pair{static_cast<float>(128.5 + 400 * std::cos(angle)),
                     static_cast<float>(128.5 + 400 * std::sin(angle))};
  };
  for (int i = 0; i < kTriangles; ++i) {
    const auto [x0, y0] = corner(i);
    const auto [x1, y1] = corner(i + 1);
    if (i % 3 == 0) {
      scene.triangle_px(x1, y1, 128.5f, 128.5f, x0, y0);
    } else {
      scene.triangle_px(128.5f, 128.5f, x0, y0, x1, y1);
    }
  }
  scene.run();
  EXPECT_EQ(scene.counts.count(1.0f), 256u * 256u);
}

TEST(Raster, ClosedMeshCoversSharedEdgesOnce) {  // RAS-50
  std::mt19937 random(3);
  CountingScene scene;
  // A grid whose inner corners are anywhere near, many of them at centres of pixels.
  constexpr int kCells = 40;
  std::vector<std::pair<float, float>> corners;
  for (int y = 0; y <= kCells; ++y) {
    for (int x = 0; x <= kCells; ++x) {
      const auto place = [&](int i) {
        if (i == 0 || i == kCells) return static_cast<float>(i) * 6.4f;
        const auto shift = static_cast<float>(static_cast<int>(random() % 1024) - 512) / 256;
        const float inner = static_cast<float>(i) * 6.4f + shift;
        return random() % 3 == 0 ? std::floor(inner) + 0.5f : inner;
      };
      const float px = place(x);
      corners.emplace_back(px, place(y));
    }
  }
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const auto at = [&](int dx, int dy) {
        return corners[static_cast<size_t>((y + dy) * (kCells + 1) + x + dx)];
      };
      const auto [ax, ay] = at(0, 0);
      const auto [bx, by] = at(1, 0);
      const auto [cx, cy] = at(0, 1);
      const auto [dx, dy] = at(1, 1);
      scene.triangle_px(ax, ay, bx, by, cx, cy);
      scene.triangle_px(cx, cy, bx, by, dx, dy);
    }
  }
  scene.run();
  // Cells that are turned inside out cover pixels twice more often than their neighbours less.
  uint32_t even = 0;
  for (uint32_t y = 0; y < 256; ++y) {
    for (uint32_t x = 0; x < 256; ++x) {
      const auto count = static_cast<uint32_t>(scene.counts.at<float>(x, y));
      even += count % 2 == 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(even, 0u);
  EXPECT_GT(scene.counts.count(1.0f), 60000u);
}

TEST(Raster, NothingWithoutArea) {  // RAS-51
  CountingScene scene;
  scene.triangle_px(10.5f, 10.5f, 20.5f, 20.5f, 30.5f, 30.5f);
  scene.triangle_px(10.5f, 10.5f, 10.5f, 10.5f, 10.5f, 10.5f);
  scene.run();
  EXPECT_EQ(scene.counts.count(0.0f), 256u * 256u);
  // The smallest area there is, with a centre on its left edge.
  scene.clear_vertices();
  scene.triangle_px(50.5f, 50.0f, 50.5f + 1.0f / 256, 50.5f, 50.5f, 51.0f);
  scene.run();
  EXPECT_EQ(scene.counts.at<float>(50, 50), 1.0f);
  EXPECT_EQ(scene.counts.count(0.0f), 256u * 256u - 1);
}

TEST(Raster, WindingCullModeAndFlagDecide) {  // RAS-52, RAS-53
  for (const bool clockwise : {true, false}) {
    for (const bool counter_clockwise_is_front : {true, false}) {
      for (const auto cull :
           {rtapi::CullMode::kNone, rtapi::CullMode::kFront, rtapi::CullMode::kBack}) {
        Scene scene;
        TestTexture& target = scene.add_target(Format::kR32G32B32A32Uint);
        const uint32_t face = scene.add_pixel_input(scene.linked.pixel_columns.is_front_face);
        scene.shade([&](shader::PixelLanes& lanes) {
          for (int i = 0; i < 8; ++i) {
            lanes.outputs[0][i] = lanes.inputs[face][i];
            lanes.outputs[1][i] = 7;
          }
        });
        scene.linked.rasterizer.CullMode = cull;
        scene.linked.rasterizer.FrontCounterClockwise = counter_clockwise_is_front;
        if (clockwise) {
          scene.triangle_px(10, 10, 20, 10, 10, 20);
        } else {
          scene.triangle_px(10, 10, 10, 20, 20, 10);
        }
        scene.run();
        const bool front = clockwise != counter_clockwise_is_front;
        const bool culled =
            front ? cull == rtapi::CullMode::kFront : cull == rtapi::CullMode::kBack;
        const auto texel = target.at<std::array<uint32_t, 4>>(12, 12);
        EXPECT_EQ(texel[1], culled ? 0u : 7u);
        if (!culled) {
          EXPECT_EQ(texel[0], front ? ~0u : 0u);
        }
      }
    }
  }
}

TEST(Raster, ScissorQuartersAreTheWhole) {  // RAS-55
  const auto draw = [](const std::vector<rtapi::Rect>& scissors) {
    auto scene = std::make_unique<CountingScene>();
    std::mt19937 random(11);
    testing::add_random_triangles(*scene, testing::TriangleKind::kMedium, 500, random);
    for (const rtapi::Rect& scissor : scissors) {
      scene->state.scissors[0] = scissor;
      scene->run();
    }
    return scene->counts.bytes();
  };
  const auto whole = draw({{0, 0, 256, 256}});
  EXPECT_EQ(whole,
            draw({{0, 0, 101, 77}, {101, 0, 256, 77}, {0, 77, 101, 256}, {101, 77, 256, 256}}));
}

// Every pixel that triangles of a kind cover, and in what order, against the reference.
void compare_with_reference(testing::TriangleKind kind) {
  constexpr uint32_t kSize = 200;  // no multiple of a tile
  constexpr uint32_t kBatch = 250;
  const uint32_t triangles = testing::random_triangle_count();
  std::mt19937 random(5);
  for (uint32_t done = 0; done < triangles; done += kBatch) {
    Scene scene(kSize, kSize);
    TestTexture& target = scene.add_target(Format::kR32Uint);
    const uint32_t id = scene.add_pixel_input(scene.linked.pixel_columns.primitive_id);
    scene.shade([&](shader::PixelLanes& lanes) {
      for (int i = 0; i < 8; ++i) lanes.outputs[0][i] = lanes.inputs[id][i] + 1;
    });
    testing::add_random_triangles(scene, kind, kBatch, random);
    scene.run(2);
    std::vector<uint32_t> expected(kSize * kSize);
    for (uint32_t i = 0; i < kBatch; ++i) {
      const testing::ReferenceTriangle triangle(testing::corners_of(scene, i).v,
                                                scene.state.viewports[0]);
      for (uint32_t y = 0; y < kSize; ++y) {
        for (uint32_t x = 0; x < kSize; ++x) {
          if (triangle.covers(static_cast<int32_t>(x), static_cast<int32_t>(y))) {
            expected[y * kSize + x] = i + 1;
          }
        }
      }
    }
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) {
        ASSERT_EQ(target.at<uint32_t>(x, y), expected[y * kSize + x])
            << "pixel " << x << ' ' << y << ", triangles from " << done;
      }
    }
    ASSERT_TRUE(target.padding_is_intact());
  }
}

TEST(RasterReference, SmallTriangles) {
  compare_with_reference(testing::TriangleKind::kSmall);
}
TEST(RasterReference, MediumTriangles) {
  compare_with_reference(testing::TriangleKind::kMedium);
}
TEST(RasterReference, HugeTriangles) {  // RAS-54
  compare_with_reference(testing::TriangleKind::kHuge);
}
TEST(RasterReference, Slivers) {
  compare_with_reference(testing::TriangleKind::kSliver);
}
TEST(RasterReference, CornersAtPixelCenters) {  // RAS-49
  compare_with_reference(testing::TriangleKind::kCenters);
}

}  // namespace
}  // namespace kaamos::raster
