// SPDX-License-Identifier: MIT
//
// Rules of rounding to subpixels, coverage and facing.
#include <cmath>
#include <random>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

// Adds 1 at each covered pixel of target 0.
PipelineState adding(Screen& screen) {
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Tint");
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].DestBlend = Blend::kOne;
  return screen.make(desc);
}

void positions_are_rounded_to_even(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = screen.make("Pass", "Value");
  constexpr float kHalf = 1.0f / 512;  // of a subpixel
  // Borders 10.5 and 20.5 of subpixels 2688 and 5248, and whether pixels 10 and 20 are inside.
  const auto check = [&](float left, float right, bool first, bool last) {
    for (const bool vertical : {false, true}) {
      screen.draw(pipeline, vertical ? screen.rectangle(2, left, 40, right)
                                     : screen.rectangle(left, 2, right, 40));
      const auto at = [&](uint32_t i) {
        return (vertical ? screen.texel<float>(30, i) : screen.texel<float>(i, 30)) != 0;
      };
      const std::string what = (vertical ? "rows " : "columns ") + std::to_string(left) + " to " +
                               std::to_string(right) + ", pixel ";
      t.equal(what + "9", at(9), false);
      t.equal(what + "10", at(10), first);
      t.equal(what + "11", at(11), true);
      t.equal(what + "19", at(19), true);
      t.equal(what + "20", at(20), last);
      t.equal(what + "21", at(21), false);
    }
  };
  check(10.5f, 20.5f, true, false);
  check(10.5f + kHalf, 20.5f + kHalf, true, false);                // 2688.5 to 2688
  check(10.5f + kHalf * 1.5f, 20.5f + kHalf * 1.5f, false, true);  // 2688.75 to 2689
  check(10.5f - kHalf, 20.5f - kHalf, true, false);                // 2687.5 to 2688
  check(10.5f + kHalf * 0.5f, 20.5f - kHalf * 0.5f, true, false);
  check(10.5f + kHalf * 3, 20.5f + kHalf * 3, false, true);  // 2689.5 to 2690
}

void top_left_rule(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = adding(screen);
  screen.draw(pipeline, screen.rectangle(0.5f, 0.5f, 4.5f, 4.5f));
  t.equal("px that differ", screen.differing<float>([](uint32_t x, uint32_t y) {
    return x < 4 && y < 4 ? 1.0f : 0.0f;
  }),
          0u);
  // The same corners, counterclockwise.
  std::vector<Corner> corners = screen.rectangle(0.5f, 0.5f, 4.5f, 4.5f);
  std::swap(corners[0], corners[1]);
  std::swap(corners[3], corners[4]);
  screen.draw(pipeline, corners);
  t.equal("counterclockwise: px that differ", screen.differing<float>([](uint32_t x, uint32_t y) {
    return x < 4 && y < 4 ? 1.0f : 0.0f;
  }),
          0u);
  // A centre on a slanted edge: in on the left side, out on the right.
  screen.draw(pipeline, {screen.at(10.5f, 10.5f), screen.at(14.5f, 14.5f), screen.at(6.5f, 14.5f)});
  uint32_t area = 0;
  t.equal("slanted: px that differ", screen.count([&](uint32_t ux, uint32_t uy) {
    const auto x = static_cast<int>(ux), y = static_cast<int>(uy);
    // Rows 10 to 13: from the left edge at 10 - (y - 10), inclusive, to the right one, exclusive.
    const bool inside = y >= 10 && y < 14 && x >= 20 - y && x < y;
    area += inside ? 1 : 0;
    return (screen.texel<float>(ux, uy) != 0) != inside;
  }),
          0u);
  t.equal("slanted: px", area, 12u);
}

void shared_edges_once(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = adding(screen);
  // A fan around the centre of a pixel, closed at the border of a square beyond the target.
  constexpr uint32_t kTriangles = 1000;
  std::vector<Corner> rim;
  for (uint32_t i = 0; i < kTriangles; ++i) {
    const float along = static_cast<float>(i % 250) / 250 * 300;  // of a side
    const float places[4][2] = {
        {-22 + along, -22}, {278, -22 + along}, {278 - along, 278}, {-22, 278 - along}};
    rim.push_back(screen.at(places[i / 250][0], places[i / 250][1]));
  }
  std::vector<Corner> corners;
  std::mt19937 random(5);
  std::vector<uint32_t> order(kTriangles);
  for (uint32_t i = 0; i < kTriangles; ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  for (const uint32_t i : order) {
    const Corner next = rim[(i + 1) % kTriangles];
    corners.push_back(screen.at(100.5f, 77.5f));
    // Both windings.
    corners.push_back(i % 3 == 0 ? rim[i] : next);
    corners.push_back(i % 3 == 0 ? next : rim[i]);
  }
  screen.draw(pipeline, corners);
  t.equal("fan: px that are not 1",
          screen.differing<float>([](uint32_t, uint32_t) { return 1.0f; }), 0u);
}

void no_area_no_pixels(Context& t) {
  Screen screen(t, {Format::kR32Float});
  for (const CullMode cull : {CullMode::kNone, CullMode::kFront, CullMode::kBack}) {
    GraphicsPipelineStateDesc desc = screen.desc("Pass", "Tint");
    desc.RasterizerState.CullMode = cull;
    const PipelineState pipeline = screen.make(desc);
    const std::string what = "cull mode " + std::to_string(static_cast<uint32_t>(cull));
    screen.draw(pipeline,
                {screen.at(10.5f, 10.5f), screen.at(20.5f, 20.5f), screen.at(30.5f, 30.5f),
                 screen.at(10.5f, 40.5f), screen.at(30.5f, 40.5f), screen.at(20.5f, 40.5f)});
    t.equal(what + ", no area: px", screen.covered(), 0u);
    // Half a square subpixel: the centre is on its top and left edges.
    constexpr float kSub = 1.0f / 256;
    screen.draw(pipeline, {screen.at(10.5f, 10.5f), screen.at(10.5f + kSub, 10.5f),
                           screen.at(10.5f, 10.5f + kSub)});
    t.equal(what + ", smallest: px", screen.covered(), cull == CullMode::kFront ? 0u : 1u);
    // Here on none.
    screen.draw(pipeline, {screen.at(10.5f, 10.5f), screen.at(10.5f, 10.5f - kSub),
                           screen.at(10.5f + kSub, 10.5f)});
    t.equal(what + ", smallest, above: px", screen.covered(), 0u);
  }
}

void facing_and_culling(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Uint}, Format::kUnknown, 16);
  const std::vector<Corner> clockwise = {screen.at(0, 0), screen.at(32, 0), screen.at(0, 32)};
  const std::vector<Corner> counterclockwise = {clockwise[0], clockwise[2], clockwise[1]};
  for (const bool flag : {false, true}) {
    for (const CullMode cull : {CullMode::kNone, CullMode::kFront, CullMode::kBack}) {
      GraphicsPipelineStateDesc desc = screen.desc("Pass", "Facts");
      desc.RasterizerState.CullMode = cull;
      desc.RasterizerState.FrontCounterClockwise = flag;
      const PipelineState pipeline = screen.make(desc);
      for (const bool turned : {false, true}) {
        const bool front = turned == flag;
        const bool drawn = cull == CullMode::kNone || (cull == CullMode::kBack) == front;
        screen.draw(pipeline, turned ? counterclockwise : clockwise);
        const std::string what = std::string(turned ? "counterclockwise" : "clockwise") +
                                 ", flag " + std::to_string(flag) + ", cull mode " +
                                 std::to_string(static_cast<uint32_t>(cull));
        t.equal(what, screen.fact(5, 5).covered, drawn);
        if (drawn) t.equal(what + ": SV_IsFrontFace", screen.fact(5, 5).front, front);
      }
    }
  }
}

std::vector<Corner> random_mesh(Screen& screen, uint32_t triangles) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> place(-30, 286), extent(-40, 40), depth(0, 1);
  std::vector<Corner> out;
  for (uint32_t i = 0; i < triangles; ++i) {
    const float x = place(random), y = place(random);
    for (int corner = 0; corner < 3; ++corner) {
      const float px = x + extent(random), py = y + extent(random);
      out.push_back(screen.at(px, py, depth(random), 1 + 3 * depth(random)));
    }
  }
  return out;
}

void scissors_do_not_move_coverage(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float);
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Tint");
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].DestBlend = Blend::kOne;
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kAlways;
  const PipelineState pipeline = screen.make(desc);
  const std::vector<Corner> mesh = random_mesh(screen, 500);
  screen.draw(pipeline, mesh);
  const auto image = [&] {
    std::vector<uint32_t> out;
    for (uint32_t y = 0; y < 256; ++y) {
      for (uint32_t x = 0; x < 256; ++x) {
        out.push_back(screen.texel<uint32_t>(x, y));
        out.push_back(screen.depth_bits(x, y));
      }
    }
    return out;
  };
  const std::vector<uint32_t> whole = image();
  screen.run([&](CommandList& list) {
    for (const Rect& rect : {Rect{0, 0, 101, 77}, Rect{101, 0, 256, 77}, Rect{0, 77, 101, 256},
                             Rect{101, 77, 256, 256}}) {
      list.RSSetScissorRects(rect);
      screen.draw(list, pipeline, mesh);
    }
  });
  t.holds("four parts are the whole", image() == whole);
}

}  // namespace

std::vector<RuleTest> ras_coverage_tests() {
  return {{"RAS-47, RAS-48", positions_are_rounded_to_even},
          {"RAS-49", top_left_rule},
          {"RAS-50", shared_edges_once},
          {"RAS-51", no_area_no_pixels, "*"},
          {"RAS-52, RAS-53", facing_and_culling, "*"},
          {"RAS-55", scissors_do_not_move_coverage}};
}

}  // namespace kaamos::conformance
