// SPDX-License-Identifier: MIT
//
// Tests which vertices form triangles, and what shaders see of their numbers: RAS-02 to RAS-10,
// RAS-12, RAS-19, RAS-20.
#include "runtime/raster/primitives.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>

#include "runtime/raster/testing/scene.h"

namespace kaamos::raster {
namespace {

using rtapi::Format;
using testing::Scene;
using testing::TestTexture;
using Cut = rtapi::IndexBufferStripCutValue;

// Records what the vertex shader is called with, and per pixel the primitive's number + 1, the
// leading vertex's first attribute and whether the pixel is front facing.
struct RecordingScene : Scene {
  RecordingScene() : Scene(256, 256, 1), target(add_target(Format::kR32G32B32A32Uint)) {
    id = add_pixel_input(linked.pixel_columns.primitive_id);
    face = add_pixel_input(linked.pixel_columns.is_front_face);
    flat = add_varying(4, 1, shader::Interpolation::kNoInterpolation);
    shade([this](shader::PixelLanes& lanes) {
      for (int i = 0; i < 8; ++i) {
        lanes.outputs[0][i] = lanes.inputs[id][i] + 1;
        lanes.outputs[1][i] = lanes.inputs[flat][i];
        lanes.outputs[2][i] = lanes.inputs[face][i];
        lanes.outputs[3][i] = 1;
      }
    });
  }
  // Columns of SV_VertexID and SV_InstanceID behind the vertex.
  void record_ids() {
    linked.vertex_columns.vertex_id = 5;
    linked.vertex_columns.instance_id = 6;
    vertex_desc.input_columns = 7;
    more_vertex = [this](const shader::VertexLanes& lanes) {
      const std::lock_guard lock(mutex);
      for (int i = 0; i < 8; ++i) {
        if ((lanes.active >> i & 1) == 0) continue;
        ++calls[{lanes.inputs[6][i], lanes.inputs[5][i]}];
        read[{lanes.inputs[6][i], lanes.inputs[5][i]}] = testing::as_float(lanes.inputs[4][i]);
      }
    };
  }
  std::array<uint32_t, 4> at(uint32_t x, uint32_t y) {
    return target.at<std::array<uint32_t, 4>>(x, y);
  }
  TestTexture& target;
  uint32_t id, face, flat;
  std::mutex mutex;
  std::map<std::pair<uint32_t, uint32_t>, int> calls;   // by instance and vertex id
  std::map<std::pair<uint32_t, uint32_t>, float> read;  // the attribute that was fetched
};

TEST(RasterPrimitives, ListDropsWhatIsLeft) {  // RAS-02
  RecordingScene scene;
  for (int i = 0; i < 8; ++i) {
    scene.vertex_px(static_cast<float>(10 + 20 * (i / 3) + (i % 3 == 1 ? 10 : 0)),
                    static_cast<float>(i % 3 == 2 ? 20 : 10), 0.5f);
  }
  scene.run();
  EXPECT_EQ(scene.at(12, 12)[0], 1u);
  EXPECT_EQ(scene.at(32, 12)[0], 2u);
  EXPECT_EQ(scene.at(52, 12)[0], 0u);
}

TEST(RasterPrimitives, StripTurnsEverySecondTriangle) {  // RAS-03
  RecordingScene scene;
  scene.state.topology = rtapi::PrimitiveTopology::kTriangleStrip;
  scene.linked.rasterizer.CullMode = rtapi::CullMode::kBack;
  const float colors[4] = {testing::as_float(10), testing::as_float(11), testing::as_float(12),
                           testing::as_float(13)};
  scene.vertex_px(0, 0, 0.5f, {colors[0]});
  scene.vertex_px(100, 0, 0.5f, {colors[1]});
  scene.vertex_px(0, 100, 0.5f, {colors[2]});
  scene.vertex_px(100, 100, 0.5f, {colors[3]});
  scene.run();
  EXPECT_EQ(scene.at(10, 10), (std::array<uint32_t, 4>{1, 10, ~0u, 1}));
  EXPECT_EQ(scene.at(90, 90), (std::array<uint32_t, 4>{2, 11, ~0u, 1}));
  EXPECT_EQ(scene.target.count(0u), 256u * 256 - 10000);
}

TEST(RasterPrimitives, CutEndsAStrip) {  // RAS-04
  RecordingScene scene;
  scene.state.topology = rtapi::PrimitiveTopology::kTriangleStrip;
  scene.linked.rasterizer.CullMode = rtapi::CullMode::kBack;
  scene.linked.strip_cut = Cut::k0xFFFFFFFF;
  scene.vertex_px(0, 0);
  scene.vertex_px(100, 0);
  scene.vertex_px(0, 100);
  scene.vertex_px(100, 100);
  scene.set_indices({0, 1, 2, 0xFFFFFFFF, 2, 1, 3});
  scene.run();
  EXPECT_EQ(scene.at(10, 10)[0], 1u);
  EXPECT_EQ(scene.at(90, 90)[0], 2u);
  EXPECT_EQ(scene.at(90, 90)[2], ~0u);
  EXPECT_EQ(scene.target.count(0u), 256u * 256 - 10000);
}

TEST(RasterPrimitives, OnlyTheValueOfThePipelineCuts) {  // RAS-05
  const auto triangles = [](Cut cut, std::vector<uint32_t> indices, bool sixteen) {
    RecordingScene scene;
    scene.state.topology = rtapi::PrimitiveTopology::kTriangleStrip;
    scene.linked.strip_cut = cut;
    for (int i = 0; i < 65536; ++i) {
      scene.vertex_px(i == 65535 || i % 2 == 1 ? 100 : 0, i >= 2 ? 100 : 0);
    }
    scene.set_indices(std::move(indices), sixteen);
    scene.run();
    return (scene.at(10, 10)[0] != 0 ? 1 : 0) + (scene.at(90, 90)[0] != 0 ? 1 : 0);
  };
  EXPECT_EQ(triangles(Cut::kDisabled, {0, 1, 2, 0xFFFF}, true), 2);
  EXPECT_EQ(triangles(Cut::k0xFFFF, {0, 1, 2, 0xFFFF}, true), 1);
  EXPECT_EQ(triangles(Cut::k0xFFFFFFFF, {0, 1, 2, 0xFFFF}, true), 2);
  EXPECT_EQ(triangles(Cut::k0xFFFF, {0, 1, 2, 0xFFFF}, false), 1);
  EXPECT_EQ(triangles(Cut::kDisabled, {0, 1, 2, 0xFFFF}, false), 2);
}

TEST(RasterPrimitives, IndicesBeyondTheViewAreZero) {  // RAS-07
  RecordingScene scene;
  scene.record_ids();
  scene.triangle_px(0, 0, 100, 0, 0, 100);
  scene.set_indices({0, 1, 2});
  scene.index_count = 6;
  scene.run();
  EXPECT_EQ(scene.target.count(1u) > 4000, true);
  EXPECT_EQ(scene.target.count(2u), 0u);
  EXPECT_EQ(scene.calls.size(), 3u);
}

TEST(RasterPrimitives, BaseVertexIsNotInTheId) {  // RAS-08
  RecordingScene scene;
  scene.record_ids();
  for (int i = 0; i < 16; ++i) scene.vertex_px(0, 0, 0.5f, {static_cast<float>(i)});
  scene.set_indices({6, 7, 8});
  Draw draw = scene.draw();
  draw.arguments.BaseVertexLocation = 4;
  Rasterizer rasterizer;
  auto workers = scene.workers(1);
  rasterizer.draw(scene.targets(), {&draw, 1}, workers);
  const std::map<std::pair<uint32_t, uint32_t>, float> expected = {
      {{0, 6}, 10.0f}, {{0, 7}, 11.0f}, {{0, 8}, 12.0f}};
  EXPECT_EQ(scene.read, expected);
  scene.read.clear();
  draw.arguments.BaseVertexLocation = -6;
  rasterizer.draw(scene.targets(), {&draw, 1}, workers);
  EXPECT_EQ((scene.read[{0, 6}]), 0.0f);
  EXPECT_EQ((scene.read[{0, 8}]), 2.0f);
}

TEST(RasterPrimitives, StartIndexMovesTheFetch) {
  RecordingScene scene;
  scene.record_ids();
  for (int i = 0; i < 9; ++i) scene.vertex_px(0, 0, 0.5f, {static_cast<float>(i)});
  scene.set_indices({8, 7, 6, 5, 4, 3}, true);
  Draw draw = scene.draw();
  draw.arguments.StartIndexLocation = 3;
  draw.arguments.IndexCountPerInstance = 3;
  Rasterizer rasterizer;
  auto workers = scene.workers(1);
  rasterizer.draw(scene.targets(), {&draw, 1}, workers);
  const std::map<std::pair<uint32_t, uint32_t>, float> expected = {
      {{0, 3}, 3.0f}, {{0, 4}, 4.0f}, {{0, 5}, 5.0f}};
  EXPECT_EQ(scene.read, expected);
}

TEST(RasterPrimitives, IdsBeginAtZero) {  // RAS-09, RAS-10
  RecordingScene scene;
  scene.record_ids();
  scene.state.topology = rtapi::PrimitiveTopology::kTriangleStrip;
  for (int i = 0; i < 16; ++i) scene.vertex_px(0, 0, 0.5f, {static_cast<float>(i)});
  scene.instances = 2;
  Draw draw = scene.draw();
  draw.arguments.IndexCountPerInstance = 4;
  draw.arguments.StartIndexLocation = 12;
  draw.arguments.StartInstanceLocation = 5;
  Rasterizer rasterizer;
  auto workers = scene.workers(1);
  rasterizer.draw(scene.targets(), {&draw, 1}, workers);
  for (uint32_t instance = 0; instance < 2; ++instance) {
    for (uint32_t i = 0; i < 4; ++i) {
      EXPECT_EQ((scene.read[{instance, i}]), 12.0f + static_cast<float>(i));
    }
  }
  EXPECT_EQ(scene.read.size(), 8u);
}

TEST(RasterPrimitives, PrimitiveIdsBeginAnewWithInstanceAndDraw) {  // RAS-12
  RecordingScene scene;
  scene.linked.vertex_columns.instance_id = 5;
  scene.vertex_desc.input_columns = 6;
  scene.more_vertex = [](const shader::VertexLanes& lanes) {
    for (int i = 0; i < 8; ++i) {
      const float shift = static_cast<float>(lanes.inputs[5][i]) * 0.5f;
      lanes.outputs[1][i] = testing::as_bits(testing::as_float(lanes.inputs[1][i]) - shift);
    }
  };
  scene.quad_px(0, 0, 50, 50);
  scene.instances = 2;
  const Draw draws[2] = {scene.draw(), scene.draw()};
  Rasterizer rasterizer;
  auto workers = scene.workers(1);
  rasterizer.draw(scene.targets(), draws, workers);
  for (const uint32_t y : {0u, 64u}) {
    EXPECT_EQ(scene.at(10, y + 10)[0], 1u);
    EXPECT_EQ(scene.at(40, y + 40)[0], 2u);
  }
  EXPECT_EQ(scene.target.count(3u), 0u);
}

TEST(RasterPrimitives, EmptyDrawsDrawNothing) {  // RAS-144
  for (const auto& [vertices, instances] : {std::pair{0u, 1u}, {6u, 0u}, {2u, 1u}}) {
    RecordingScene scene;
    scene.record_ids();
    scene.quad_px(0, 0, 256, 256);
    Draw draw = scene.draw();
    draw.arguments.IndexCountPerInstance = vertices;
    draw.arguments.InstanceCount = instances;
    Rasterizer rasterizer;
    auto workers = scene.workers(1);
    rasterizer.draw(scene.targets(), {&draw, 1}, workers);
    EXPECT_EQ(scene.target.count(0u), 256u * 256);
    EXPECT_TRUE(scene.calls.empty());
  }
}

TEST(RasterPrimitives, EachVertexOfABatchIsShadedOnce) {  // RAS-20
  for (const uint32_t stride : {1u, 1000003u}) {          // near each other, and far apart
    RecordingScene scene;
    scene.record_ids();
    scene.floats.resize(5);
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < 300; ++i) {
      for (const uint32_t corner : {i, i + 1, i + 2}) indices.push_back(5 + corner * stride);
    }
    scene.set_indices(indices);
    scene.run();
    EXPECT_EQ(scene.calls.size(), 302u);
    for (const auto& [vertex, count] : scene.calls) EXPECT_EQ(count, 1) << vertex.second;
  }
}

TEST(RasterPrimitives, CursorCutsEveryTriangleOnce) {
  Scene scene;
  scene.state.topology = rtapi::PrimitiveTopology::kTriangleStrip;
  scene.linked.strip_cut = Cut::k0xFFFF;
  scene.set_indices({1, 2, 3, 4, 5, 0xFFFF, 7, 8, 0xFFFF, 0xFFFF, 1, 2, 3, 0xFFFF}, true);
  scene.instances = 2;
  const Draw draw = scene.draw();
  RangeCursor cursor(draw, 9, 2);
  std::vector<std::array<uint64_t, 4>> found;
  PrimitiveRange range;
  while (cursor.next(range)) {
    EXPECT_EQ(range.draw, 9u);
    EXPECT_EQ(range.odd, false);
    found.push_back({range.instance, range.first, range.primitive_id, range.count});
  }
  const std::vector<std::array<uint64_t, 4>> expected = {{0, 0, 0, 2}, {0, 2, 2, 1}, {0, 10, 3, 1},
                                                         {1, 0, 0, 2}, {1, 2, 2, 1}, {1, 10, 3, 1}};
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace kaamos::raster
