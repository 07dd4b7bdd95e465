// SPDX-License-Identifier: MIT
//
// Rules of geometry shaders. [D3D11.3: 13]
#include <shaders/ras_geometry.h>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr uint32_t kSide = 64;

// Targets of facts, of the leading vertex of what covers each pixel.
struct Drawing {
  explicit Drawing(Context& t) : screen(t, {Format::kR32G32B32A32Uint}, Format::kUnknown, kSide) {
    screen.library = kaamos_shaders_ras_geometry();
  }
  void draw(const std::string& geometry, PrimitiveTopologyType type,
            const std::vector<Corner>& corners, const DrawConstants& constants = {},
            const std::string& pixel = "Seen", CullMode cull = CullMode::kNone) {
    GraphicsPipelineStateDesc desc = screen.desc("Pass", pixel);
    if (!geometry.empty()) desc.GS = screen.shader(geometry);
    desc.PrimitiveTopologyType = type;
    desc.RasterizerState.CullMode = cull;
    const PipelineState pipeline = screen.make(desc);
    screen.run([&](CommandList& list) {
      list.IASetPrimitiveTopology(
          type == PrimitiveTopologyType::kPoint  ? PrimitiveTopology::kPointList
          : type == PrimitiveTopologyType::kLine ? PrimitiveTopology::kLineList
                                                 : PrimitiveTopology::kTriangleList);
      screen.draw(list, pipeline, corners, constants);
    });
  }
  uint32_t covered() const {
    return screen.count([&](uint32_t x, uint32_t y) { return screen.fact(x, y).covered; });
  }
  Screen screen;
};

void what_is_handed_on_is_drawn(Context& t) {
  Drawing drawing(t);
  std::vector<Corner> corners;
  for (uint32_t i = 0; i < 40; ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t place = (i * 3 + k) * 2654435761u;
      corners.push_back(drawing.screen.at(static_cast<float>(place >> 8 & 0xFFFF) / 1024,
                                          static_cast<float>(place >> 16) / 1024, 0.5f, 1,
                                          {static_cast<float>(i), 0, 0, 0}));
    }
  }
  for (const CullMode cull : {CullMode::kNone, CullMode::kBack}) {
    drawing.draw("", PrimitiveTopologyType::kTriangle, corners, {}, "Seen", cull);
    std::vector<uint32_t> expected;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      expected.push_back(drawing.screen.texel<uint32_t>(i % kSide, i / kSide, 0));
    }
    t.holds("something is drawn", drawing.covered() > 500);
    drawing.draw("HandOn", PrimitiveTopologyType::kTriangle, corners, {}, "Seen", cull);
    t.equal("differing pixels",
            drawing.screen.differing<uint32_t>(
                [&](uint32_t x, uint32_t y) { return expected[y * kSide + x]; }, 0),
            0u);
  }
}

void points_become_squares(Context& t) {
  Drawing drawing(t);
  drawing.draw("Square", PrimitiveTopologyType::kPoint,
               {drawing.screen.at(8, 8, 0.5f, 1, {5, 0, 0, 0}), drawing.screen.at(40, 24)}, {},
               "Facts");
  t.equal("covered", drawing.covered(), 32u);
  const Fact first = drawing.screen.fact(9, 11), second = drawing.screen.fact(43, 27);
  t.equal("element", first.element, 5u);
  t.equal("SV_PrimitiveID", first.primitive, 100u);
  t.equal("SV_PrimitiveID", second.primitive, 101u);
  t.equal("SV_VertexID", second.vertex, 1u);
}

void triangles_become_lines_and_points(Context& t) {
  Drawing drawing(t);
  const std::vector<Corner> corners = {drawing.screen.at(8.5f, 8.5f),
                                       drawing.screen.at(40.5f, 8.5f),
                                       drawing.screen.at(8.5f, 40.5f)};
  drawing.draw("Border", PrimitiveTopologyType::kTriangle, corners);
  t.holds("edges", drawing.screen.fact(20, 8).covered && drawing.screen.fact(8, 20).covered);
  t.holds("inside", !drawing.screen.fact(12, 12).covered);
  drawing.draw("Corners", PrimitiveTopologyType::kTriangle, corners);
  t.equal("points", drawing.covered(), 3u);
}

void each_instance_is_a_call(Context& t) {
  Drawing drawing(t);
  drawing.draw("Row", PrimitiveTopologyType::kPoint, {drawing.screen.at(2, 30)});
  t.equal("covered", drawing.covered(), 8 * 16u);
  for (uint32_t i = 0; i < 8; ++i) {
    t.equal("SV_GSInstanceID", drawing.screen.fact(2 + 8 * i, 31).element, i + 1);
  }
}

void strips_end_where_they_are_cut(Context& t) {
  Drawing drawing(t);
  DrawConstants constants;
  constants.number = 2;
  const std::vector<Corner> point = {drawing.screen.at(8, 8)};
  constants.tint[0] = 0;
  drawing.draw("Pile", PrimitiveTopologyType::kPoint, point, constants);
  t.equal("covered", drawing.covered(), 16u);
  t.equal("of the second strip", drawing.screen.fact(9, 9).element, 2u);
  constants.tint[0] = 1;
  drawing.draw("Pile", PrimitiveTopologyType::kPoint, point, constants);
  t.equal("of the first strip", drawing.screen.fact(9, 9).element, 1u);
  constants.tint[0] = 2;
  drawing.draw("Pile", PrimitiveTopologyType::kPoint, point, constants);
  t.equal("strips of a vertex", drawing.covered(), 0u);
}

void turned_triangles_face_the_same_way(Context& t) {
  Drawing drawing(t);
  const std::vector<Corner> point = {drawing.screen.at(8, 8)};
  drawing.draw("Row", PrimitiveTopologyType::kPoint, point, {}, "Seen", CullMode::kBack);
  t.equal("of clockwise strips", drawing.covered(), 7 * 16u);
  t.holds("front", drawing.screen.fact(11, 11).front);
}

void no_more_than_the_most_vertices(Context& t) {
  Drawing drawing(t);
  for (const uint32_t count : {0u, 1u, 3u, 5u}) {
    DrawConstants constants;
    constants.number = count;
    constants.tint[0] = 0;
    drawing.draw("Pile", PrimitiveTopologyType::kPoint, {drawing.screen.at(8, 8)}, constants);
    t.equal("covered", drawing.covered(), count == 0 ? 0u : 16u);
    // What is emitted last is drawn last.
    t.equal("on top", drawing.screen.fact(9, 9).element, std::min(count, 3u));
  }
}

void stages_fit(Context& t) {
  Drawing drawing(t);
  const auto make = [&](const std::string& geometry, const std::string& pixel,
                        PrimitiveTopologyType type) {
    GraphicsPipelineStateDesc desc = drawing.screen.desc("Pass", pixel);
    desc.GS = drawing.screen.shader(geometry);
    desc.PrimitiveTopologyType = type;
    return t.device().CreateGraphicsPipelineState(desc);
  };
  t.refused("a line for a triangle", make("HandOn", "Seen", PrimitiveTopologyType::kLine),
            "KA0724");
  t.refused("SV_PrimitiveID of none", make("HandOn", "Facts", PrimitiveTopologyType::kTriangle),
            "KA0724");
  t.holds("SV_PrimitiveID", make("Square", "Facts", PrimitiveTopologyType::kPoint).ok());
}

}  // namespace

std::vector<RuleTest> ras_geometry_tests() {
  return {{"RAS-163", what_is_handed_on_is_drawn},
          {"RAS-163", points_become_squares},
          {"RAS-163", triangles_become_lines_and_points},
          {"RAS-164", each_instance_is_a_call},
          {"RAS-165", strips_end_where_they_are_cut},
          {"RAS-165", turned_triangles_face_the_same_way},
          {"RAS-166", no_more_than_the_most_vertices},
          {"RAS-167", stages_fit}};
}

}  // namespace kaamos::conformance
