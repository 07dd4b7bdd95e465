// SPDX-License-Identifier: MIT
//
// Rules of points, lines and edges of triangles.
#include <shaders/ras_lines.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/conformance/ras_depth.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr uint32_t kSide = 64;
constexpr Format kFactFormat = Format::kR32G32B32A32Uint;

GraphicsPipelineStateDesc described(const Screen& screen, PrimitiveTopologyType type,
                                    const std::string& pixel) {
  GraphicsPipelineStateDesc desc = screen.desc("Pass", pixel);
  desc.PrimitiveTopologyType = type;
  return desc;
}

// Each pixel counts how often it is covered.
PipelineState counting(const Screen& screen, GraphicsPipelineStateDesc desc) {
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].DestBlend = Blend::kOne;
  return screen.make(desc);
}

void draw(Screen& screen, PrimitiveTopology topology, const PipelineState& pipeline,
          const std::vector<Corner>& corners) {
  screen.run([&](CommandList& list) {
    list.IASetPrimitiveTopology(topology);
    screen.draw(list, pipeline, corners);
  });
}

std::vector<float> counts(const Screen& screen) {
  std::vector<float> out;
  for (uint32_t y = 0; y < screen.size(); ++y) {
    for (uint32_t x = 0; x < screen.size(); ++x) out.push_back(screen.texel<float>(x, y));
  }
  return out;
}

// ---------------------------------------------------------------------------------------------
// Points

void points_are_pixels(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, kSide);
  const PipelineState pipeline =
      screen.make(described(screen, PrimitiveTopologyType::kPoint, "Facts"));
  std::mt19937 random(56);
  std::uniform_int_distribution<int> place(0, kSide * 256 - 1);
  std::vector<Corner> corners;
  std::vector<std::array<uint32_t, 2>> pixels;
  for (uint32_t i = 0; i < 100; ++i) {
    const int x = place(random) | 1, y = place(random) | 1;
    corners.push_back(screen.at(static_cast<float>(x) / 256, static_cast<float>(y) / 256, 0.5f,
                                1 + static_cast<float>(i % 3), {static_cast<float>(i), 0, 0, 0}));
    pixels.push_back({static_cast<uint32_t>(x) / 256, static_cast<uint32_t>(y) / 256});
  }
  draw(screen, PrimitiveTopology::kPointList, pipeline, corners);
  uint32_t wrong = 0, covered = 0;
  for (uint32_t i = 0; i < 100; ++i) {
    const Fact fact = screen.fact(pixels[i][0], pixels[i][1]);
    // A later point may have the same pixel.
    wrong += !fact.covered || fact.primitive != fact.element || fact.primitive < i ||
                     fact.vertex != fact.primitive || !fact.front
                 ? 1
                 : 0;
  }
  std::sort(pixels.begin(), pixels.end());
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  covered = screen.count([&](uint32_t x, uint32_t y) { return screen.fact(x, y).covered; });
  t.equal("wrong points", wrong, 0u);
  t.equal("covered pixels", covered, static_cast<uint32_t>(pixels.size()));
}

void points_are_seen_as_vertices_are(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, kSide);
  // Points are never culled.
  GraphicsPipelineStateDesc desc = described(screen, PrimitiveTopologyType::kPoint, "Tint");
  desc.RasterizerState.CullMode = CullMode::kFront;
  const PipelineState pipeline = counting(screen, desc);
  draw(screen, PrimitiveTopology::kPointList, pipeline,
       {screen.at(8.5f, 8.5f, 0), screen.at(16.5f, 8.5f, 1), screen.at(24.5f, 8.5f, -0.25f),
        screen.at(32.5f, 8.5f, 1.25f), screen.at(40.5f, 8.5f, 0.5f, -1)});
  t.equal("between near and far", screen.texel<float>(8, 8) + screen.texel<float>(16, 8), 2.0f);
  t.equal("covered", screen.covered(), 2u);
}

// ---------------------------------------------------------------------------------------------
// Lines

struct Segment {
  long double x[2], y[2];  // of its ends, in pixels
};

// What a pixel's diamond says, in real numbers.
enum class Diamond { kOutside, kLeft, kEndsIn, kTooClose };

Diamond diamond_of(const Segment& s, uint32_t px, uint32_t py) {
  constexpr long double kClose = 1e-6L;
  const long double cx = px + 0.5L, cy = py + 0.5L;
  const auto distance = [&](long double along) {
    const long double x = s.x[0] + along * (s.x[1] - s.x[0]);
    const long double y = s.y[0] + along * (s.y[1] - s.y[0]);
    return std::fabs(x - cx) + std::fabs(y - cy) - 0.5L;
  };
  // The least distance is at an end or where the line crosses an axis of the diamond.
  long double least = std::min(distance(0), distance(1));
  for (const auto& [from, to, center] :
       {std::array{s.x[0], s.x[1], cx}, std::array{s.y[0], s.y[1], cy}}) {
    if (from == to) continue;
    const long double along = (center - from) / (to - from);
    if (along > 0 && along < 1) least = std::min(least, distance(along));
  }
  if (std::fabs(least) < kClose) return Diamond::kTooClose;
  if (least > 0) return Diamond::kOutside;
  const long double end = distance(1);
  if (std::fabs(end) < kClose) return Diamond::kTooClose;
  return end < 0 ? Diamond::kEndsIn : Diamond::kLeft;
}

// Counts pixels that are not covered as often as lines leave their diamonds.
uint32_t differing(const Screen& screen, const std::vector<Segment>& segments, uint32_t& judged) {
  uint32_t wrong = 0;
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      float expected = 0;
      bool clear = true;
      for (const Segment& segment : segments) {
        const Diamond diamond = diamond_of(segment, x, y);
        clear = clear && diamond != Diamond::kTooClose;
        expected += diamond == Diamond::kLeft ? 1.0f : 0.0f;
      }
      if (!clear) continue;
      ++judged;
      wrong += screen.texel<float>(x, y) != expected ? 1 : 0;
    }
  }
  return wrong;
}

void lines_leave_diamonds(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, kSide);
  const PipelineState pipeline =
      counting(screen, described(screen, PrimitiveTopologyType::kLine, "Tint"));
  std::mt19937 random(57);
  for (const int reach : {3, 30, 200}) {
    std::uniform_int_distribution<int> place(0, kSide * 256), step(-reach * 256, reach * 256);
    std::vector<Corner> corners;
    std::vector<Segment> segments;
    for (uint32_t i = 0; i < 60; ++i) {
      Segment segment;
      const int x = place(random), y = place(random);
      const int ends[2][2] = {{x, y}, {x + step(random), y + step(random)}};
      for (int end = 0; end < 2; ++end) {
        segment.x[end] = ends[end][0] / 256.0L;
        segment.y[end] = ends[end][1] / 256.0L;
        corners.push_back(
            screen.at(static_cast<float>(segment.x[end]), static_cast<float>(segment.y[end])));
      }
      segments.push_back(segment);
    }
    draw(screen, PrimitiveTopology::kLineList, pipeline, corners);
    uint32_t judged = 0;
    const uint32_t wrong = differing(screen, segments, judged);
    t.holds("most pixels are judged", judged > kSide * kSide * 3 / 4);
    t.equal("lines of up to " + std::to_string(reach) + " pixels: wrong", wrong, 0u);
  }
}

void ends_of_lines_meet(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, kSide);
  const PipelineState pipeline =
      counting(screen, described(screen, PrimitiveTopologyType::kLine, "Tint"));
  std::mt19937 random(58);
  std::uniform_int_distribution<int> place(256, (kSide - 1) * 256);
  for (int i = 0; i < 8; ++i) {
    // From pixel to pixel in one direction, by way of a point on the line.
    const int y = place(random) | 1;
    const std::vector<Corner> corners = {
        screen.at(2.5f, static_cast<float>(y) / 256),
        screen.at(static_cast<float>(place(random)) / 256, static_cast<float>(y) / 256),
        screen.at(61.5f, static_cast<float>(y) / 256)};
    draw(screen, PrimitiveTopology::kLineStrip, pipeline, corners);
    uint32_t once = 0;
    for (uint32_t x = 0; x < kSide; ++x) once += screen.texel<float>(x, y / 256) == 1.0f ? 1 : 0;
    t.equal("pixels that are covered once", once, 59u);
    t.equal("covered pixels", screen.covered(), 59u);
  }
}

void strips_of_lines_are_cut(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, kSide);
  GraphicsPipelineStateDesc desc = described(screen, PrimitiveTopologyType::kLine, "Facts");
  desc.IBStripCutValue = IndexBufferStripCutValue::k0xFFFF;
  const PipelineState pipeline = screen.make(desc);
  std::vector<Corner> corners;
  for (uint32_t i = 0; i < 6; ++i) {
    corners.push_back(screen.at(static_cast<float>(10 * i) + 0.5f, 20.5f, 0.5f, 1,
                                {static_cast<float>(i), 0, 0, 0}));
  }
  screen.run([&](CommandList& list) {
    list.IASetPrimitiveTopology(PrimitiveTopology::kLineStrip);
    Screen::use(list, pipeline);
    screen.vertices(list, corners);
    screen.indices<uint16_t>(list, {0, 1, 2, 0xFFFF, 3, 4, 5});
    list.DrawIndexedInstanced(7, 1, 0, 0, 0);
  });
  for (const auto& [x, primitive] : {std::array{5u, 0u}, {15u, 1u}, {35u, 2u}, {45u, 3u}}) {
    const Fact fact = screen.fact(x, 20);
    t.holds("line " + std::to_string(primitive), fact.covered && fact.front);
    t.equal("SV_PrimitiveID", fact.primitive, primitive);
    t.equal("leading vertex", fact.element, x / 10);
  }
  t.holds("the cut", !screen.fact(25, 20).covered);
}

void attributes_change_along_lines(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD32Float, kSide);
  const PipelineState pipeline =
      screen.make(described(screen, PrimitiveTopologyType::kLine, "Value"));
  const std::array<float, 4> from = {0, 10, -1, 3}, to = {1, 20, 1, 3};
  draw(screen, PrimitiveTopology::kLineList, pipeline,
       {screen.at(8, 30.5f, 0.25f, 1, from), screen.at(40, 30.5f, 0.75f, 3, to)});
  for (uint32_t x = 8; x < 40; ++x) {
    const float s = (static_cast<float>(x) + 0.5f - 8) / 32;
    const float inverse = (1 - s) + s / 3;
    for (uint32_t c = 0; c < 4; ++c) {
      const float expected = (from[c] * (1 - s) + to[c] * s / 3) / inverse;
      t.close("value " + std::to_string(c) + " at " + std::to_string(x),
              screen.texel<float>(x, 30, c), expected, 3e-4f);
    }
    t.close("depth", screen.depth(x, 30), 0.25f + s / 2, 1e-5f);
  }
  // A part that cannot be seen changes nothing of the rest.
  draw(screen, PrimitiveTopology::kLineList, pipeline,
       {screen.at(8, 30.5f, -0.5f, 1, from), screen.at(40, 30.5f, 0.5f, 1, to)});
  t.equal("in front of the near plane", screen.texel<float>(20, 30, 3), 0.0f);
  t.close("behind it", screen.texel<float>(32, 30, 1), 10 + 10 * 24.5f / 32, 1e-3f);
  t.close("depth behind it", screen.depth(32, 30), 24.5f / 32 - 0.5f, 1e-5f);
}

// 1.4 pixels wide, so that a line between two rows has the centres of both.
void multisampled_lines_are_rectangles(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, kSide);
  GraphicsPipelineStateDesc desc = described(screen, PrimitiveTopologyType::kLine, "Tint");
  desc.RasterizerState.MultisampleEnable = true;
  draw(screen, PrimitiveTopology::kLineList, counting(screen, desc),
       {screen.at(8, 30), screen.at(40, 30), screen.at(8, 40.5f), screen.at(40, 40.5f)});
  t.equal("covered", screen.covered(), 3u * 32);
  t.equal("above", screen.texel<float>(20, 29), 1.0f);
  t.equal("below", screen.texel<float>(20, 30), 1.0f);
  t.equal("in the middle of a row", screen.texel<float>(20, 40), 1.0f);
}

void weights_of_lines_and_points(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, kSide);
  screen.library = kaamos_shaders_ras_lines();
  const GraphicsPipelineStateDesc desc = described(screen, PrimitiveTopologyType::kLine, "Weights");
  if (t.target().backend == "vulkan") {
    // The stage that stands in for what lavapipe lacks takes triangles.
    return t.refused("lines", t.device().CreateGraphicsPipelineState(desc), "KA0967");
  }
  draw(screen, PrimitiveTopology::kLineList, screen.make(desc),
       {screen.at(8, 30.5f), screen.at(40, 30.5f)});
  const float expected[] = {0.625f - 0.5f / 32, 0.375f + 0.5f / 32, 0};
  for (uint32_t c = 0; c < 3; ++c) {
    t.close("weight " + std::to_string(c), screen.texel<float>(20, 30, c), expected[c], 1e-5f);
  }
  draw(screen, PrimitiveTopology::kPointList,
       screen.make(described(screen, PrimitiveTopologyType::kPoint, "Weights")),
       {screen.at(20.5f, 30.5f)});
  const float sum = screen.texel<float>(20, 30, 0) + screen.texel<float>(20, 30, 1) +
                    screen.texel<float>(20, 30, 2);
  t.close("a point's weights together", sum, 1, 1e-6f);
}

void lines_are_not_biased(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, kSide);
  for (const bool triangle : {false, true}) {
    GraphicsPipelineStateDesc desc = described(
        screen, triangle ? PrimitiveTopologyType::kTriangle : PrimitiveTopologyType::kLine, "Tint");
    desc.RasterizerState.DepthBias = 1 << 20;
    desc.RasterizerState.FillMode = FillMode::kWireframe;
    const PipelineState pipeline = screen.make(desc);
    draw(screen, triangle ? PrimitiveTopology::kTriangleList : PrimitiveTopology::kLineList,
         pipeline, {screen.at(8, 30.5f), screen.at(40, 30.5f), screen.at(8, 60)});
    // 2^20 steps of 2^-24.
    t.close(triangle ? "an edge" : "a line", screen.depth(20, 30), triangle ? 0.5625f : 0.5f,
            1e-6f);
  }
}

// ---------------------------------------------------------------------------------------------
// Edges of triangles

void wireframes_are_edges(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, kSide);
  const PipelineState lines =
      counting(screen, described(screen, PrimitiveTopologyType::kLine, "Tint"));
  GraphicsPipelineStateDesc desc = described(screen, PrimitiveTopologyType::kTriangle, "Tint");
  desc.RasterizerState.FillMode = FillMode::kWireframe;
  const PipelineState edges = counting(screen, desc);
  std::mt19937 random(159);
  std::uniform_real_distribution<float> place(2, kSide - 2);
  for (int i = 0; i < 10; ++i) {
    std::vector<Corner> triangle;
    for (int k = 0; k < 3; ++k) triangle.push_back(screen.at(place(random), place(random)));
    draw(screen, PrimitiveTopology::kTriangleList, edges, triangle);
    const std::vector<float> found = counts(screen);
    draw(screen, PrimitiveTopology::kLineList, lines,
         {triangle[0], triangle[1], triangle[1], triangle[2], triangle[2], triangle[0]});
    // Which of its ends an edge comes from is not said: the pixel at a corner may differ.
    const std::vector<float> expected = counts(screen);
    uint32_t differ = 0;
    for (size_t k = 0; k < found.size(); ++k) differ += (found[k] != 0) != (expected[k] != 0);
    t.holds("pixels that differ: " + std::to_string(differ), differ <= 3);
  }
}

void edges_face_as_triangles(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, kSide);
  for (const CullMode cull : {CullMode::kNone, CullMode::kBack, CullMode::kFront}) {
    GraphicsPipelineStateDesc desc = described(screen, PrimitiveTopologyType::kTriangle, "Facts");
    desc.RasterizerState.FillMode = FillMode::kWireframe;
    desc.RasterizerState.CullMode = cull;
    const std::array<float, 4> number = {7, 0, 0, 0};
    // One clockwise, one counterclockwise.
    draw(screen, PrimitiveTopology::kTriangleList, screen.make(desc),
         {screen.at(4, 4.5f, 0.5f, 1, number), screen.at(24, 4.5f), screen.at(4, 24.5f),
          screen.at(34, 4.5f, 0.5f, 1, number), screen.at(34, 24.5f), screen.at(54, 4.5f)});
    const Fact clockwise = screen.fact(12, 4), other = screen.fact(42, 4);
    t.equal("clockwise", clockwise.covered, cull != CullMode::kFront);
    t.equal("counterclockwise", other.covered, cull != CullMode::kBack);
    if (clockwise.covered) {
      t.holds("front", clockwise.front);
      t.equal("leading vertex", clockwise.element, 7u);
    }
    if (other.covered) {
      t.holds("back", !other.front);
      t.equal("SV_PrimitiveID", other.primitive, 1u);
    }
    t.holds("nothing between", !screen.fact(8, 8).covered && !screen.fact(40, 8).covered);
  }
}

// The edges that a plane makes are none.
void cut_triangles_have_their_own_edges(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, kSide);
  GraphicsPipelineStateDesc desc = described(screen, PrimitiveTopologyType::kTriangle, "Tint");
  desc.RasterizerState.FillMode = FillMode::kWireframe;
  // Depth is -0.5 at the left and 0.5 at the right: what is left of pixel 32 is cut off.
  draw(screen, PrimitiveTopology::kTriangleList, counting(screen, desc),
       {screen.at(12, 12.5f, -0.5f), screen.at(52, 12.5f, 0.5f), screen.at(12, 52.5f, -0.5f)});
  t.equal("cut off", screen.texel<float>(20, 12), 0.0f);
  t.equal("an edge", screen.texel<float>(40, 12), 1.0f);
  t.equal("where it was cut", screen.texel<float>(32, 20), 0.0f);
}

void front_is_all_bits(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 8);
  screen.library = kaamos_shaders_ras_lines();
  for (const bool flag : {false, true}) {
    GraphicsPipelineStateDesc desc = screen.desc("Whole", "FrontAsNumber");
    desc.RasterizerState.FrontCounterClockwise = flag;
    const PipelineState pipeline = screen.make(desc);
    screen.run([&](CommandList& list) { screen.cover(list, pipeline); });
    t.equal("as a number", screen.texel<uint32_t>(4, 4, 0), flag ? 0u : ~0u);
  }
}

}  // namespace

std::vector<RuleTest> ras_line_tests() {
  return {{"RAS-53", front_is_all_bits},
          {"RAS-56", points_are_pixels},
          {"RAS-56", points_are_seen_as_vertices_are},
          {"RAS-57", lines_leave_diamonds},
          {"RAS-57", ends_of_lines_meet},
          {"RAS-57", strips_of_lines_are_cut},
          {"RAS-57", attributes_change_along_lines},
          {"RAS-57", multisampled_lines_are_rectangles},
          ras_multisample_lines_test(),
          {"RAS-57, RAS-68", lines_are_not_biased},
          {"RAS-57, RAS-72", weights_of_lines_and_points},
          {"RAS-159", wireframes_are_edges},
          {"RAS-159", edges_face_as_triangles},
          {"RAS-159", cut_triangles_have_their_own_edges}};
}

}  // namespace kaamos::conformance
