// SPDX-License-Identifier: MIT
//
// Tests the checks of what becomes of draws: nothing arrives, positions and outputs that are no
// numbers, rectangles that show nothing.
#include <functional>
#include <limits>

#include "tests/checks/draw_world.h"

namespace kaamos::checks::test {
namespace {

using namespace rtapi;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class DrawResults : public DrawWorld {
 protected:
  // Draws triangles of corners x, y, z, w.
  void draw_corners(const std::vector<float>& corners,
                    const std::function<void(GraphicsPipelineStateDesc&)>& change = {}) {
    CommandList list = begin();
    list.IASetVertexBuffers(1, vertices(upload(corners, "corners"), 16));
    GraphicsPipelineStateDesc changed = desc("Constant", "FromBuffer");
    if (change) change(changed);
    list.SetPipelineState(make(changed));
    list.DrawInstanced(static_cast<uint32_t>(corners.size() / 4), 1, 0, 0);
    run(list);
  }
  const std::vector<float> whole_ = {-1, 1, 0.5f, 1, 3, 1, 0.5f, 1, -1, -3, 0.5f, 1};
};

TEST_F(DrawResults, RectanglesThatShowNothing) {
  const auto with = [&](const std::vector<Viewport>& viewports, const std::vector<Rect>& scissors) {
    CommandList list = begin();
    list.RSSetViewports(viewports);
    list.RSSetScissorRects(scissors);
    draw(list);
    run(list);
  };
  const Viewport all = {0, 0, kSize, kSize, 0, 1};
  with({all}, {{0, 0, 16, 16}});
  expect_none();
  with({}, {{0, 0, 16, 16}});
  expect_one("KA0447", {"draw 0, pipeline \"plain\" draws nothing: no viewport is set"});
  with({all}, {});
  expect_one("KA0447", {"no scissor rectangle is set"});
  with({{0, 0, 0, kSize, 0, 1}}, {{0, 0, 16, 16}});
  expect_one("KA0447", {"viewport 0 is empty: (0, 0) + (0, 16)"});
  with({all}, {{4, 4, 4, 9}});
  expect_one("KA0447", {"scissor rectangle 0 is empty: (4, 4) to (4, 9)"});
  with({all}, {{16, 0, 32, 16}});
  expect_one("KA0447", {"have nothing in common", "16 x 16"});
}

TEST_F(DrawResults, AllCulledByFacing) {
  const auto cull = [](GraphicsPipelineStateDesc& d) {
    d.RasterizerState.CullMode = CullMode::kBack;
    d.RasterizerState.FrontCounterClockwise = true;
  };
  draw_corners(whole_, cull);
  expect_one("KA0458",
             {"draw 0, pipeline \"plain\" draws nothing: all 1 triangle",
              "(1 by facing): CullMode is kBack", "counterclockwise triangles are front"});
  draw_corners(whole_, cull);  // once is enough
  expect_none();
  draw_corners(whole_, [](GraphicsPipelineStateDesc& d) {
    d.RasterizerState.CullMode = CullMode::kBack;
    d.Name = "front faces";
  });
  expect_none();
}

TEST_F(DrawResults, NoArea) {
  draw_corners(std::vector<float>{0, 0, 0.5f, 1, 0, 0, 0.5f, 1, 0, 0, 0.5f, 1});
  expect_one("KA0458", {"all 1 triangle have no area on the screen"});
}

TEST_F(DrawResults, AllOutside) {
  draw_corners({2, 0, 0.5f, 1, 3, 0, 0.5f, 1, 2, 1, 0.5f, 1});
  expect_one("KA0490", {"all 1 triangle are outside of what can be seen"});
  std::vector<float> one_inside = {2, 0, 0.5f, 1, 3, 0, 0.5f, 1, 2, 1, 0.5f, 1};
  one_inside.insert(one_inside.end(), whole_.begin(), whole_.end());
  draw_corners(one_inside, [](GraphicsPipelineStateDesc& d) { d.Name = "one inside"; });
  expect_none();
}

// Triangles that are outside, behind or turned away are drawn all the time: only a pipeline of
// which nothing arrives in the whole list is worth a word.
TEST_F(DrawResults, SomeOfAPipelinesDrawsMayBeOutside) {
  const std::vector<float> outside = {2, 0, 0.5f, 1, 3, 0, 0.5f, 1, 2, 1, 0.5f, 1};
  const PipelineState pipeline = make(desc("Constant", "FromBuffer"));
  const auto draw_list = [&](const std::vector<std::vector<float>>& draws) {
    CommandList list = begin();
    list.SetPipelineState(pipeline);
    for (const std::vector<float>& corners : draws) {
      list.IASetVertexBuffers(1, vertices(upload(corners, "corners"), 16));
      list.DrawInstanced(3, 1, 0, 0);
    }
    run(list);
  };
  draw_list({outside, whole_, outside});
  expect_none();
  draw_list({outside, outside, outside});
  expect_one("KA0490", {"draw 0, pipeline", "all 1 triangle are outside",
                        "Nothing of the list's other 2 draws with this pipeline arrives either",
                        "(DrawInstanced, command "});
}

TEST_F(DrawResults, AllFailTheDepthTest) {
  CommandList list = begin(0.25f);
  draw(list);
  run(list);
  expect_one("KA0458", {"all 256 pixels fail the depth test LESS against a depth buffer that was "
                        "cleared to 0.25 and not drawn to since"});
  // Hidden by another draw: nothing to say.
  CommandList hidden = begin();
  set_tint(hidden, 1, 0, 0, 0.25f);
  draw(hidden);
  set_tint(hidden, 1, 0, 0, 0.75f);
  GraphicsPipelineStateDesc behind = desc();
  behind.Name = "behind";
  draw(hidden, behind);
  run(hidden);
  expect_none();
}

TEST_F(DrawResults, AllDiscarded) {
  CommandList list = begin();
  draw(list, desc("Discards"));
  run(list);
  expect_one("KA0490", {"pixel shader \"Discards\" discards all 256 pixels"});
  CommandList kept = begin();
  set_tint(kept, 2);
  draw(kept, desc("Discards"));
  run(kept);
  expect_none();
}

TEST_F(DrawResults, PositionsThatAreNoNumbers) {
  std::vector<float> corners = {0, 0, kNan, 1, 3, 1, 0.5f, 1, -1, -3, 0.5f, 1};
  corners.insert(corners.end(), whole_.begin(), whole_.end());
  draw_corners(corners);
  expect_one("KA0456",
             {"draw 0, pipeline \"plain\": 1 of 6 vertices have NaN or Inf in SV_Position "
              "(first: SV_VertexID 0); 1 triangle"});
  corners[2] = 0.5f;
  corners[4] = std::numeric_limits<float>::infinity();
  draw_corners(corners);
  expect_one("KA0456", {"1 of 6 vertices", "SV_VertexID 1"});
}

TEST_F(DrawResults, PositionsFarAway) {
  std::vector<float> corners = whole_;
  corners[4] = 1e8f;
  draw_corners(corners);
  expect_one("KA0457", {"1 of 3 vertices are more than 1e7 times as far", "SV_VertexID 1"});
  corners[4] = 1e6f;
  draw_corners(corners);
  expect_none();
}

TEST_F(DrawResults, OutputsThatAreNoNumbers) {
  const auto divide = [&](float x, float y, uint32_t rtv, const std::string& pixel = "Divided") {
    CommandList list = begin();
    const float black[4] = {0, 0, 0, 0};
    list.ClearRenderTargetView(rtvs_.GetCPUDescriptorHandle(rtv), black);
    bind(list, rtv);
    set_tint(list, x, y);
    GraphicsPipelineStateDesc divided = desc(pixel);
    if (rtv == 2) divided.RTVFormats = {Format::kR8G8B8A8Unorm};
    draw(list, divided);
    run(list);
  };
  divide(1, 2, 0);
  expect_none();
  divide(0, 0, 0);
  expect_one("KA0479",
             {"draw 0, pipeline \"plain\": pixel shader \"Divided\" gave SV_Target0 NaN at "
              "256 pixels (one of them: ("});
  divide(1, 0, 0);
  expect_one("KA0479", {"Inf at 256 pixels"});
  divide(1, 0, 2);  // clamped to 1
  expect_none();
  divide(0, 0, 2);
  expect_one("KA0479", {"NaN at 256 pixels", "the target stores 0 there"});
  divide(0, 0, 0, "DividedDepth");
  expect_one("KA0479", {"gave SV_Depth NaN at 256 pixels"});
}

// The branch splits quads at x = 3, but none at x = 4. [RAS-88]
TEST_F(DrawResults, DerivativesInASplitQuad) {
  const auto split_at = [&](float x) {
    CommandList list = begin();
    set_tint(list, x);
    draw(list, desc("Diverges"));
    run(list);
  };
  split_at(4);
  expect_none();
  split_at(3);
  expect_one("KA0478",
             {"pixel shader \"Diverges\" takes a derivative", "(DrawInstanced, command 2)"});
}

TEST_F(DrawResults, EarlyDepthIgnoresParts) {
  make(desc("Discards"));
  expect_none();
  make(desc("EarlyDiscards"));
  expect_one("KA0482", {"pixel shader \"EarlyDiscards\" has [earlydepthstencil] and can discard"});
  GraphicsPipelineStateDesc tested = desc("EarlyDiscards");
  tested.DepthStencilState.DepthWriteMask = DepthWriteMask::kZero;
  make(tested);
  expect_none();
  make(desc("EarlyDepth"));
  expect_one("KA0482", {"\"EarlyDepth\" has [earlydepthstencil] and writes SV_Depth"});
}

}  // namespace
}  // namespace kaamos::checks::test
