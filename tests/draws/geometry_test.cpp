// SPDX-License-Identifier: MIT
//
// Tests geometry shaders. A shader that hands its primitives on must change no pixel; what others
// make is worked out by hand.
#include <gtest/gtest.h>
#include <shaders/geometry.h>

#include <cstring>
#include <functional>
#include <optional>
#include <random>

#include "canvas.h"
#include "on_backends.h"

namespace kaamos::draws {
namespace {

using namespace rtapi;

struct Point {
  float x, y;
};
using Texel = std::array<float, 4>;

class Geometry : public OnBackends {
 protected:
  void SetUp() override {
    OnBackends::SetUp();
    if (!can_run()) return;
    canvas_.emplace(GetParam());
    library_ = LoadShaderLibrary(kaamos_shaders_geometry()).value();
  }

  GraphicsPipelineStateDesc desc(const std::string& geometry, PrimitiveTopologyType type,
                                 const std::string& pixel = "Show",
                                 const std::string& vertex = "Vertex") const {
    GraphicsPipelineStateDesc out = canvas_->desc("WholeTarget", "Constant");
    out.VS = {library_, vertex};
    if (!geometry.empty()) out.GS = {library_, geometry};
    out.PS = {library_, pixel};
    out.InputLayout = {{.SemanticName = "POSITION", .Format = Format::kR32G32Float}};
    out.PrimitiveTopologyType = type;
    out.DSVFormat = Format::kUnknown;
    out.DepthStencilState.DepthEnable = false;
    out.Name = geometry;
    return out;
  }
  // All texels of the target.
  std::vector<Texel> draw(const GraphicsPipelineStateDesc& desc, PrimitiveTopology topology,
                          const std::vector<Point>& points, Tint tint = {},
                          uint32_t instances = 1) {
    const PipelineState pipeline = canvas_->make(desc);
    const Buffer vertices = CreateUploadBuffer(canvas_->device, points, "vertices").value();
    const VertexBufferView view = {vertices.GetGPUVirtualAddress(),
                                   static_cast<uint32_t>(vertices.size()), sizeof(Point)};
    canvas_->run([&](CommandList& list) {
      Canvas::use(list, pipeline, tint);
      list.IASetPrimitiveTopology(topology);
      list.IASetVertexBuffers(0, {&view, 1});
      list.DrawInstanced(static_cast<uint32_t>(points.size()), instances, 0, 0);
    });
    std::vector<Texel> out;
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) {
        out.push_back({canvas_->texel<float>(x, y, 0), canvas_->texel<float>(x, y, 1),
                       canvas_->texel<float>(x, y, 2), canvas_->texel<float>(x, y, 3)});
      }
    }
    return out;
  }
  static const Texel& at(const std::vector<Texel>& texels, uint32_t x, uint32_t y) {
    return texels[y * kSize + x];
  }
  static uint32_t covered(const std::vector<Texel>& texels) {
    uint32_t count = 0;
    for (const Texel& texel : texels) count += texel[3] != 0;
    return count;
  }
  // Points of a few pixels around the target, at places of the subpixel grid.
  static std::vector<Point> random_points(uint32_t count) {
    std::mt19937 random(7);
    std::vector<Point> out;
    for (uint32_t i = 0; i < count; ++i) {
      const auto next = [&] { return static_cast<float>(random() % (80 * 16)) / 16 - 8; };
      out.push_back({next(), next()});
    }
    return out;
  }

  std::optional<Canvas> canvas_;
  ShaderLibrary library_;
};
INSTANTIATE_TEST_SUITE_P(Backends, Geometry, ::testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Geometry, RAS_163_PrimitivesThatAreHandedOnAreDrawnAsTheyAre) {
  struct Case {
    const char* shader;
    PrimitiveTopologyType type;
    PrimitiveTopology topology;
  };
  const Case cases[] = {
      {"Pass", PrimitiveTopologyType::kTriangle, PrimitiveTopology::kTriangleList},
      {"Pass", PrimitiveTopologyType::kTriangle, PrimitiveTopology::kTriangleStrip},
      {"PassLine", PrimitiveTopologyType::kLine, PrimitiveTopology::kLineList},
      {"PassLine", PrimitiveTopologyType::kLine, PrimitiveTopology::kLineStrip},
      {"PassPoint", PrimitiveTopologyType::kPoint, PrimitiveTopology::kPointList}};
  const std::vector<Point> points = random_points(60);
  for (const Case& one : cases) {
    SCOPED_TRACE(std::string(one.shader) + ", topology " +
                 std::to_string(static_cast<uint32_t>(one.topology)));
    for (const CullMode cull : {CullMode::kNone, CullMode::kBack}) {
      GraphicsPipelineStateDesc with = desc(one.shader, one.type);
      GraphicsPipelineStateDesc without = desc("", one.type);
      with.RasterizerState.CullMode = without.RasterizerState.CullMode = cull;
      const auto expected = draw(without, one.topology, points);
      EXPECT_EQ(draw(with, one.topology, points), expected);
      EXPECT_GT(covered(expected), 30u);
    }
  }
}

TEST_P(Geometry, RAS_163_PointsBecomeSquares) {
  const std::vector<Point> points = {{8, 8}, {40, 8}, {8, 40}, {40, 40}};
  const auto texels = draw(desc("Sprite", PrimitiveTopologyType::kPoint, "ShowPrimitive"),
                           PrimitiveTopology::kPointList, points, {8, 0, 0, 0}, 2);
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      Texel expected = {};
      for (uint32_t i = 0; i < 4; ++i) {
        const auto [left, top] = std::pair{points[i].x - 4, points[i].y - 4};
        const auto px = static_cast<float>(x), py = static_cast<float>(y);
        if (px < left || px >= left + 8 || py < top || py >= top + 8) continue;
        // SV_PrimitiveID begins at 0 with each instance. [RAS-10]
        expected = {points[i].x, points[i].y, static_cast<float>(i),
                    static_cast<float>(i * 10 + 1)};
      }
      EXPECT_EQ(at(texels, x, y), expected) << x << ", " << y;
    }
  }
  const auto bytes = ReadbackBuffer(canvas_->device, canvas_->queue, canvas_->counter).value();
  uint32_t calls;
  std::memcpy(&calls, bytes.data(), sizeof calls);
  EXPECT_EQ(calls, 8u);
}

// Many more points than are taken together: numbers and order go on.
TEST_P(Geometry, RAS_166_ManyPrimitivesKeepTheirOrder) {
  constexpr uint32_t kPoints = 5000, kCells = 64;
  std::vector<Point> points;
  for (uint32_t i = 0; i < kPoints; ++i) {
    points.push_back({static_cast<float>(i % 8 * 8 + 4), static_cast<float>(i / 8 % 8 * 8 + 4)});
  }
  const auto texels = draw(desc("Sprite", PrimitiveTopologyType::kPoint, "ShowPrimitive"),
                           PrimitiveTopology::kPointList, points, {8, 0, 0, 0});
  for (uint32_t cell = 0; cell < kCells; ++cell) {
    const uint32_t last = cell + (kPoints - 1 - cell) / kCells * kCells;
    const Texel& texel = at(texels, cell % 8 * 8 + 5, cell / 8 * 8 + 2);
    EXPECT_EQ(texel[2], static_cast<float>(last)) << cell;
    EXPECT_EQ(texel[3], static_cast<float>(last * 10 + 1)) << cell;
  }
  EXPECT_EQ(covered(texels), kSize * kSize);
}

TEST_P(Geometry, RAS_164_EachInstanceIsACall) {
  const auto texels = draw(desc("Quarters", PrimitiveTopologyType::kPoint),
                           PrimitiveTopology::kPointList, {{16, 16}});
  EXPECT_EQ(covered(texels), 4 * 64u);
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const bool inside = x % 32 >= 12 && x % 32 < 20 && y % 32 >= 12 && y % 32 < 20;
      const Texel& texel = at(texels, x, y);
      ASSERT_EQ(texel[3] != 0, inside) << x << ", " << y;
      if (!inside) continue;
      EXPECT_NEAR(texel[0], static_cast<float>(x) + 0.5f, 1e-4f);
      EXPECT_NEAR(texel[1], static_cast<float>(y) + 0.5f, 1e-4f);
      EXPECT_EQ(texel[2], static_cast<float>(x / 32 + y / 32 * 2));
    }
  }
}

TEST_P(Geometry, RAS_165_RestartStripEndsAStrip) {
  const auto texels =
      draw(desc("Strips", PrimitiveTopologyType::kPoint), PrimitiveTopology::kPointList, {{8, 8}});
  // The halves of two squares; the edge pixels belong to one side.
  EXPECT_EQ(at(texels, 9, 9)[2], 0.0f);
  EXPECT_EQ(at(texels, 9, 9)[3], 1.0f);
  EXPECT_EQ(at(texels, 25, 9)[2], 3.0f);
  EXPECT_EQ(at(texels, 15, 15)[3], 0.0f);
  EXPECT_EQ(at(texels, 20, 12)[3], 0.0f);  // between them
  EXPECT_EQ(at(texels, 12, 26)[3], 0.0f);  // two vertices
  EXPECT_EQ(covered(texels), 2 * 28u);
}

TEST_P(Geometry, RAS_165_EverySecondTriangleOfAStripIsTurned) {
  const auto texels =
      draw(desc("Strip", PrimitiveTopologyType::kPoint), PrimitiveTopology::kPointList, {{16, 16}});
  EXPECT_EQ(covered(texels), 16 * 16u);
  EXPECT_EQ(at(texels, 17, 17), (Texel{16, 16, 0, 1}));  // the first vertex of each leads
  EXPECT_EQ(at(texels, 30, 30), (Texel{16, 16, 1, 1}));
}

TEST_P(Geometry, RAS_166_WhatIsEmittedLastIsDrawnLastAndNoMoreThanAllowed) {
  const GraphicsPipelineStateDesc many = desc("Many", PrimitiveTopologyType::kPoint);
  const std::vector<Point> points = {{16, 16}, {48, 48}};
  for (const uint32_t count : {0u, 1u, 2u, 3u}) {
    SCOPED_TRACE(count);
    const auto texels =
        draw(many, PrimitiveTopology::kPointList, points, {0, static_cast<float>(count), 0, 0});
    EXPECT_EQ(covered(texels), count == 0 ? 0 : 2 * 64u);
    EXPECT_EQ(at(texels, 16, 16)[2], static_cast<float>(std::min(count, 2u)));
    EXPECT_EQ(at(texels, 48, 48)[2], static_cast<float>(std::min(count, 2u)));
  }
}

TEST_P(Geometry, RAS_163_TrianglesBecomeLinesAndPoints) {
  const std::vector<Point> points = {{8.5f, 8.5f}, {40.5f, 8.5f}, {8.5f, 40.5f}};
  const std::vector<Point> edges = {points[0], points[1], points[1],
                                    points[2], points[2], points[0]};
  const PrimitiveTopologyType triangle = PrimitiveTopologyType::kTriangle;
  const auto as_lines = draw(desc("Edges", triangle), PrimitiveTopology::kTriangleList, points);
  const auto lines =
      draw(desc("", PrimitiveTopologyType::kLine), PrimitiveTopology::kLineList, edges);
  ASSERT_GT(covered(lines), 90u);
  for (uint32_t i = 0; i < kSize * kSize; ++i) {
    EXPECT_EQ(as_lines[i][3] != 0, lines[i][3] != 0) << i % kSize << ", " << i / kSize;
  }
  const auto as_points = draw(desc("Corners", triangle), PrimitiveTopology::kTriangleList, points);
  EXPECT_EQ(covered(as_points), 3u);
  EXPECT_EQ(at(as_points, 8, 40), (Texel{8.5f, 40.5f, 2, 1}));
}

TEST_P(Geometry, RAS_163_VerticesHoldMatricesArraysAndDistances) {
  const std::vector<Point> points = {{0, 0}, {128, 0}, {0, 128}};
  const auto texels =
      draw(desc("RichPass", PrimitiveTopologyType::kTriangle, "RichPixel", "RichVertex"),
           PrimitiveTopology::kTriangleList, points);
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const auto px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
      const Texel& texel = at(texels, x, y);
      if (x >= 32) {
        EXPECT_EQ(texel, Texel{}) << x << ", " << y;
        continue;
      }
      // Of 1, 2 and 3 at the corners.
      const float factor = 1 + px / 128 + 2 * py / 128;
      EXPECT_NEAR(texel[0], 21 * factor, 1e-3f);
      EXPECT_NEAR(texel[1], px, 1e-3f);
      EXPECT_NEAR(texel[2], py, 1e-3f);
      EXPECT_EQ(texel[3], -10.0f);  // of the leading vertex
    }
  }
}

TEST_P(Geometry, RAS_156_QueriesCountCallsAndWhatTheyMake) {
  const PipelineState pipeline = canvas_->make(desc("Quarters", PrimitiveTopologyType::kPoint));
  const std::vector<Point> points = {{16, 16}, {8, 8}};
  const Buffer vertices = CreateUploadBuffer(canvas_->device, points, "vertices").value();
  const VertexBufferView view = {vertices.GetGPUVirtualAddress(),
                                 static_cast<uint32_t>(vertices.size()), sizeof(Point)};
  QueryHeapDesc heap_desc;
  heap_desc.Type = QueryHeapType::kPipelineStatistics;
  heap_desc.Count = 1;
  const QueryHeap heap = canvas_->device.CreateQueryHeap(heap_desc).value();
  BufferDesc buffer;
  buffer.SizeInBytes = sizeof(QueryDataPipelineStatistics);
  buffer.InitialState = ResourceStates::kCopyDest;
  const Buffer result = canvas_->device.CreateBuffer(buffer).value();
  canvas_->run([&](CommandList& list) {
    Canvas::use(list, pipeline);
    list.IASetPrimitiveTopology(PrimitiveTopology::kPointList);
    list.IASetVertexBuffers(0, {&view, 1});
    list.BeginQuery(heap, QueryType::kPipelineStatistics, 0);
    list.DrawInstanced(2, 1, 0, 0);
    list.EndQuery(heap, QueryType::kPipelineStatistics, 0);
    list.ResolveQueryData(heap, QueryType::kPipelineStatistics, 0, 1, result, 0);
  });
  const auto bytes = ReadbackBuffer(canvas_->device, canvas_->queue, result).value();
  QueryDataPipelineStatistics found;
  std::memcpy(&found, bytes.data(), sizeof found);
  EXPECT_EQ(found.IAPrimitives, 2u);
  EXPECT_EQ(found.VSInvocations, 2u);
  // A driver fault: lavapipe counts the instances of a call once, where Vulkan asks for each.
  EXPECT_EQ(found.GSInvocations, on_vulkan() ? 2u : 8u);
  EXPECT_EQ(found.GSPrimitives, 16u);  // two triangles of each call
  EXPECT_EQ(found.CInvocations, 16u);
}

TEST_P(Geometry, RAS_167_StagesMustFit) {
  const auto expect_refused = [&](const GraphicsPipelineStateDesc& desc, const std::string& why) {
    const auto made = canvas_->device.CreateGraphicsPipelineState(desc);
    ASSERT_FALSE(made.ok()) << why;
    EXPECT_EQ(made.error().id.text(), "KA0724");
    EXPECT_NE(made.error().message.find(why), std::string::npos) << made.error().message;
  };
  const PrimitiveTopologyType triangle = PrimitiveTopologyType::kTriangle;
  expect_refused(desc("Pass", PrimitiveTopologyType::kLine),
                 "takes a triangle, but PrimitiveTopologyType is 2");
  expect_refused(desc("WritesNoPosition", triangle),
                 "geometry shader \"WritesNoPosition\" writes no SV_Position");
  expect_refused(desc("Pass", triangle, "ShowPrimitive"), "reads SV_PrimitiveID0");
  expect_refused(desc("Pass", triangle, "Show", "PositionAlone"),
                 "geometry shader \"Pass\" reads VALUE0");
}

}  // namespace
}  // namespace kaamos::draws
