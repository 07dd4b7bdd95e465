// SPDX-License-Identifier: MIT
//
// Tests what is cut away: RAS-26 to RAS-36.
#include "runtime/raster/clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "runtime/raster/testing/scene.h"

namespace kaamos::raster {
namespace {

using rtapi::Format;
using testing::as_bits;
using testing::as_float;
using testing::Scene;
using testing::TestTexture;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct CountingScene : Scene {
  explicit CountingScene(uint32_t attributes = 0)
      : Scene(256, 256, attributes), counts(add_target(Format::kR32Float)) {
    auto& blend = linked.blend[0];
    blend.BlendEnable = true;
    blend.SrcBlend = blend.DestBlend = rtapi::Blend::kOne;
    shade_constant(1, 1, 1, 1);
  }
  uint32_t covered() { return 256u * 256u - counts.count(0.0f); }
  TestTexture& counts;
};

TEST(RasterClip, DepthRange) {  // RAS-26
  CountingScene scene;
  // z/w is -0.5 at the left border and 1.5 at the right one.
  for (const auto& [x, y] : {std::pair{-1.0f, 1.0f},
                             {1.0f, 1.0f},
                             {-1.0f, -1.0f},
                             {-1.0f, -1.0f},
                             {1.0f, 1.0f},
                             {1.0f, -1.0f}}) {
    scene.vertex(x, y, x + 0.5f, 1);
  }
  scene.run();
  for (uint32_t y = 0; y < 256; ++y) {
    for (uint32_t x = 0; x < 256; ++x) {
      const bool inside = x >= 64 && x < 192;
      ASSERT_EQ(scene.counts.at<float>(x, y), inside ? 1.0f : 0.0f) << x << ' ' << y;
    }
  }
}

TEST(RasterClip, WithoutDepthClipDepthIsClamped) {  // RAS-27
  const float nothing = 0.125f;
  const float depths[5] = {0, 0.5f, -0.5f, 1, 1.5f};
  const float clipped[5] = {0, 0.5f, nothing, 1, nothing};
  const float clamped[5] = {0, 0.5f, 0, 1, 1};
  for (const bool clip : {true, false}) {
    for (int i = 0; i < 5; ++i) {
      Scene scene(64, 64);
      TestTexture& depth = scene.add_depth(Format::kD32Float);
      depth.fill(nothing);
      scene.linked.rasterizer.DepthClipEnable = clip;
      scene.quad_px(0, 0, 64, 64, depths[i]);
      scene.run();
      EXPECT_EQ(testing::texels_other_than(depth, clip ? clipped[i] : clamped[i]), 0u)
          << clip << ' ' << depths[i];
    }
  }
}

// A floor below the eye reaches from behind it to the horizon.
TEST(RasterClip, WhatIsBehindTheEyeIsCutOff) {  // RAS-28, RAS-29
  for (const bool depth_clip : {true, false}) {
    CountingScene scene;
    scene.linked.rasterizer.DepthClipEnable = depth_clip;
    // Clip space of a point (x, -1, z) in view space: (x, -1, z * 0.001, z).
    const auto at = [&](float x, float z) { scene.vertex(x, -1, z * 0.001f, z); };
    at(-1e6f, -1e6f);
    at(-1e6f, 1e6f);
    at(1e6f, 1e6f);
    at(-1e6f, -1e6f);
    at(1e6f, 1e6f);
    at(1e6f, -1e6f);
    scene.run();
    for (uint32_t y = 0; y < 256; ++y) {
      for (uint32_t x = 0; x < 256; ++x) {
        ASSERT_EQ(scene.counts.at<float>(x, y), y < 128 ? 0.0f : 1.0f) << x << ' ' << y;
      }
    }
  }
  CountingScene behind;
  behind.quad(-1, -1, 1, 1, 0.5f, -1);
  behind.run();
  EXPECT_EQ(behind.covered(), 0u);
}

TEST(RasterClip, DirectionsAreVertices) {  // RAS-29
  CountingScene scene;
  scene.linked.rasterizer.DepthClipEnable = false;
  scene.vertex(-1, -1, 0, 1);  // lower left
  scene.vertex(1, -1, 0, 1);   // lower right
  scene.vertex(0, 1, 0, 0);    // up, at infinity
  scene.run();
  EXPECT_EQ(scene.covered(), 256u * 256u);
  EXPECT_EQ(scene.counts.count(1.0f), 256u * 256u);
  CountingScene denormal;
  denormal.linked.rasterizer.DepthClipEnable = false;
  denormal.vertex(-1, -1, 0, 1);
  denormal.vertex(1, -1, 0, 1);
  denormal.vertex(0, 1, 0, 1e-40f);
  denormal.run();
  EXPECT_EQ(denormal.counts.count(1.0f), 256u * 256u);
}

TEST(RasterClip, NaNAndInfinityDropTheirTrianglesOnly) {  // RAS-30, RAS-31
  for (const float odd : {std::nanf(""), kInfinity, -kInfinity}) {
    for (int coordinate = 0; coordinate < 4; ++coordinate) {
      CountingScene scene;
      scene.state.topology = rtapi::PrimitiveTopology::kTriangleStrip;
      for (int i = 0; i < 6; ++i) {
        scene.vertex_px(static_cast<float>(i / 2) * 100, i % 2 == 0 ? 0.0f : 100.0f);
      }
      scene.floats[4 * 1 + static_cast<size_t>(coordinate)] = odd;
      scene.run();
      EXPECT_EQ(scene.counts.count(1.0f), 10000u) << odd << ' ' << coordinate;
      EXPECT_EQ(scene.counts.at<float>(99, 1), 0.0f);
      EXPECT_EQ(scene.counts.at<float>(199, 1), 1.0f);
    }
  }
}

TEST(RasterClip, HugeTriangles) {  // RAS-32
  for (const float far : {1e5f, 1e7f, 1e10f, 1e20f, 1e30f, 1e35f}) {
    CountingScene scene;
    scene.vertex(-far, -far, 0.5f, 1);
    scene.vertex(0, far, 0.5f, 1);
    scene.vertex(far, -far, 0.5f, 1);
    scene.run();
    EXPECT_EQ(scene.counts.count(1.0f), 256u * 256u) << far;
  }
}

TEST(RasterClip, FlatValuesAreThoseOfTheLeadingVertex) {  // RAS-33, RAS-74
  Scene scene(256, 256, 1);
  TestTexture& target = scene.add_target(Format::kR32Uint);
  const uint32_t flat = scene.add_varying(4, 1, shader::Interpolation::kNoInterpolation);
  scene.shade_columns(flat, 1);
  constexpr uint32_t kBits = 0x7FA00001;  // a signalling NaN
  scene.vertex(0, -1, -1, -1, {as_float(kBits)});
  scene.vertex(-20, 5, 5, 10, {1});
  scene.vertex(20, 5, 5, 10, {2});
  scene.run();
  EXPECT_GT(target.count(kBits), 1000u);
  EXPECT_EQ(target.count(kBits) + target.count(0u), 256u * 256u);
}

TEST(RasterClip, NewVerticesAreLinear) {  // RAS-33
  for (const auto interpolation :
       {shader::Interpolation::kLinear, shader::Interpolation::kNoPerspective}) {
    // The same quad, cut by the near plane on the left or not at all.
    const auto draw = [&](bool depth_clip) {
      auto scene = std::make_unique<Scene>(256, 256, 1);
      scene->add_target(Format::kR32Float);
      scene->linked.rasterizer.DepthClipEnable = depth_clip;
      scene->shade_columns(scene->add_varying(4, 1, interpolation), 1);
      const auto corner = [&](float x, float y) {
        const float w = 2 + x;
        scene->vertex(x * w, y * w, (x + 0.5f) * w * 0.5f, w, {x + 3 * y});
      };
      corner(-1, 1);
      corner(1, 1);
      corner(-1, -1);
      corner(-1, -1);
      corner(1, 1);
      corner(1, -1);
      scene->run();
      return scene;
    };
    const auto cut = draw(true);
    const auto whole = draw(false);
    for (uint32_t y = 0; y < 256; ++y) {
      for (uint32_t x = 0; x < 256; ++x) {
        if (x < 64) {
          ASSERT_EQ(cut->color[0]->at<float>(x, y), 0.0f);
        } else {
          ASSERT_NEAR(cut->color[0]->at<float>(x, y), whole->color[0]->at<float>(x, y), 3e-5f)
              << x << ' ' << y;
        }
      }
    }
  }
}

TEST(RasterClip, ClipDistances) {  // RAS-34
  const auto covered = [](float left, float right) {
    auto scene = std::make_unique<CountingScene>(1);
    scene->linked.vertex_columns.clip_distances = {4};
    for (const auto& [x, y] : {std::pair{-1.0f, 1.0f},
                               {1.0f, 1.0f},
                               {-1.0f, -1.0f},
                               {-1.0f, -1.0f},
                               {1.0f, 1.0f},
                               {1.0f, -1.0f}}) {
      scene->vertex(x, y, 0.5f, 1, {x < 0 ? left : right});
    }
    scene->run();
    return scene;
  };
  const auto half = covered(-1, 1);
  for (uint32_t x = 0; x < 256; ++x) {
    ASSERT_EQ(half->counts.at<float>(x, 17), x >= 128 ? 1.0f : 0.0f) << x;
  }
  EXPECT_EQ(half->counts.count(1.0f), 128u * 256u);
  EXPECT_EQ(covered(0, 0)->counts.count(1.0f), 256u * 256u);
  EXPECT_EQ(covered(-1, -1)->covered(), 0u);
  EXPECT_EQ(covered(1, std::nanf(""))->covered(), 0u);
}

TEST(RasterClip, CullDistances) {  // RAS-35
  const auto covered = [](float a, float b, float c) {
    CountingScene scene(1);
    scene.linked.vertex_columns.cull_distances = {4};
    scene.vertex_px(0, 0, 0.5f, {a});
    scene.vertex_px(100, 0, 0.5f, {b});
    scene.vertex_px(0, 100, 0.5f, {c});
    scene.run();
    return scene.covered();
  };
  const uint32_t whole = covered(1, 1, 1);
  EXPECT_GT(whole, 4900u);
  EXPECT_EQ(covered(-1, -1, 0), whole);
  EXPECT_EQ(covered(-1, -1, -1), 0u);
  EXPECT_EQ(covered(-1, -1, std::nanf("")), 0u);
}

TEST(RasterClip, InnerEdgesCoverEachPixelOnce) {  // RAS-36
  std::mt19937 random(8);
  const auto between = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  for (int i = 0; i < 300; ++i) {
    CountingScene scene(2);
    scene.linked.vertex_columns.clip_distances = {4, 5};
    // Two triangles that share an edge, on both sides of it.
    std::vector<std::array<float, 6>> corners;
    for (int c = 0; c < 4; ++c) {
      corners.push_back({between(-9, 9), between(-9, 9), between(-2, 4), between(-1, 4),
                         between(-1, 2), between(-1, 2)});
    }
    const auto add = [&](int c) {
      const auto& v = corners[static_cast<size_t>(c)];
      scene.vertex(v[0], v[1], v[2], v[3], {v[4], v[5]});
    };
    for (const int c : {0, 1, 2}) add(c);
    scene.run();
    EXPECT_EQ(scene.counts.count(0.0f) + scene.counts.count(1.0f), 256u * 256u) << i;
  }
}

// Two halves of a quad through the eye: the shared edge's pixels are covered once.
TEST(RasterClip, SharedEdgesStayShared) {  // RAS-50
  std::mt19937 random(9);
  const auto between = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  for (int i = 0; i < 300; ++i) {
    CountingScene scene;
    // A parallelogram in space: its triangles do not overlap.
    const float o[3] = {between(-5, 5), between(-5, 5), between(0.2f, 5)};
    const float u[3] = {between(-9, 9), between(-9, 9), between(-9, 9)};
    const float v[3] = {between(-9, 9), between(-9, 9), between(-9, 9)};
    const auto add = [&](float s, float t) {
      float p[3];
      for (int c = 0; c < 3; ++c) p[c] = o[c] + s * u[c] + t * v[c];
      scene.vertex(p[0], p[1], p[2] - 0.1f, p[2]);
    };
    add(-1, -1);
    add(1, -1);
    add(-1, 1);
    if (i % 2 == 0) {
      add(1, -1);
      add(1, 1);
    } else {
      add(1, 1);
      add(1, -1);
    }
    add(-1, 1);
    scene.run();
    ASSERT_EQ(scene.counts.count(0.0f) + scene.counts.count(1.0f), 256u * 256u) << i;
  }
}

}  // namespace
}  // namespace kaamos::raster
