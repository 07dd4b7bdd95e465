// SPDX-License-Identifier: MIT
//
// Tests what is said about a pixel of draws, and counts of overdraw. Expected texts and counts are
// worked out by hand.
#include <gtest/gtest.h>
#include <rtapi/explain_draw.h>

#include <cstring>

#include "canvas.h"
#include "tests/vulkan/support.h"

namespace kaamos::draws {
namespace {

using namespace rtapi;

// Every triangle is the whole target: corners at pixels (0, 0), (128, 0), (0, 128).
class ExplainDraws : public ::testing::Test {
 protected:
  GraphicsPipelineStateDesc desc(const std::string& pixel) const {
    GraphicsPipelineStateDesc desc = canvas_.desc("WholeTarget", pixel);
    desc.DepthStencilState.DepthFunc = ComparisonFunc::kLess;
    desc.Name = pixel.empty() ? "depth only" : pixel;
    return desc;
  }
  void draw(CommandList& list, const GraphicsPipelineStateDesc& desc, Tint tint) const {
    Canvas::use(list, canvas_.make(desc), tint);
    list.DrawInstanced(3, 1, 0, 0);
  }
  // Passes, fails, is discarded at odd pixels, culled, tested late.
  CommandList five_draws() {
    return canvas_.list([&](CommandList& list) {
      draw(list, desc("Constant"), {1, 0, 0, 0.75f});
      draw(list, desc("Constant"), {0, 1, 0, 0.875f});
      draw(list, desc("Checkerboard"), {0, 0, 0, 0.5f});
      GraphicsPipelineStateDesc culled = desc("Constant");
      culled.RasterizerState.CullMode = CullMode::kFront;
      culled.Name = "culled";
      draw(list, culled, {0, 0, 1, 0.125f});
      draw(list, desc("Counted"), {0, 0, 1, 0.25f});
    });
  }

  Canvas canvas_{"embree"};
};

TEST_F(ExplainDraws, TellsTheTrianglesOfAPixelInOrder) {
  CommandList list = five_draws();
  const DrawPixelExplanation found =
      ExplainDrawPixel(canvas_.queue, list, {.X = 17, .Y = 4}).value();
  const std::string text = ToText(found);
  EXPECT_EQ(text.substr(text.find('\n') + 1), R"(5 draws; 5 triangles in the order of drawing:
  draw 0 (DrawInstanced, command 2), "Constant": instance 0, triangle 0, front face: written
    weights 0.828125 0.13671875 0.03515625
    z 0.75; depth 0.75 LESS 1 before the pixel shader: passed, stored
    pixel "Constant": SV_Target0 = 1 0 0 0.75
    target 0: 0 0 0 0 -> 1 0 0 0.75
  draw 1 (DrawInstanced, command 3), "Constant": instance 0, triangle 0, front face: failed the depth test
    weights 0.828125 0.13671875 0.03515625
    z 0.875; depth 0.875 LESS 0.75 before the pixel shader: failed
  draw 2 (DrawInstanced, command 4), "Checkerboard": instance 0, triangle 0, front face: discarded
    weights 0.828125 0.13671875 0.03515625
    z 0.5; depth 0.5 LESS 0.75 before the pixel shader: passed
    pixel "Checkerboard" discarded it
  draw 3 (DrawInstanced, command 5), "culled": instance 0, triangle 0, front face: culled
    weights 0.828125 0.13671875 0.03515625
  draw 4 (DrawInstanced, command 6), "Counted": instance 0, triangle 0, front face: written
    weights 0.828125 0.13671875 0.03515625
    z 0.25; depth 0.25 LESS 0.75 after the pixel shader: passed, stored
    pixel "Counted": SV_Target0 = 0 0 1 0.25
    target 0: 1 0 0 0.75 -> 0 0 1 0.25
)");
  EXPECT_EQ(text.substr(0, text.find(" on ")), "pixel (17, 4) of slice 0 of 64 x 64");
  ASSERT_EQ(found.Triangles.size(), 5u);
  EXPECT_EQ(found.Triangles[3].Outcome, TriangleOutcome::kCulledByFace);
  EXPECT_TRUE(found.Triangles[4].TestedLate);
}

TEST_F(ExplainDraws, TellsTheStencilTest) {
  const Texture both = canvas_.device
                           .CreateTexture({.Width = kSize,
                                           .Height = kSize,
                                           .Format = Format::kD24UnormS8Uint,
                                           .Flags = ResourceFlags::kAllowDepthStencil,
                                           .InitialState = ResourceStates::kDepthWrite})
                           .value();
  const CpuDescriptorHandle dsv = canvas_.dsvs.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle rtv = canvas_.rtvs.GetCPUDescriptorHandle(0);
  canvas_.device.CreateDepthStencilView(both, dsv).value();
  CommandList list = canvas_.list([&](CommandList& l) {
    l.ClearDepthStencilView(dsv, ClearFlags::kStencil, 0, 5);
    l.OMSetRenderTargets(1, &rtv, false, &dsv);
    l.OMSetStencilRef(5);
    for (const char* pixel : {"Constant", "Counted"}) {
      GraphicsPipelineStateDesc equal = desc(pixel);
      equal.DSVFormat = Format::kD24UnormS8Uint;
      equal.DepthStencilState.StencilEnable = true;
      equal.DepthStencilState.DepthFunc = ComparisonFunc::kAlways;
      equal.DepthStencilState.FrontFace.StencilFunc = ComparisonFunc::kEqual;
      equal.DepthStencilState.FrontFace.StencilPassOp = StencilOp::kIncr;
      draw(l, equal, {1, 0, 0, 0.5f});
    }
  });
  const DrawPixelExplanation found =
      ExplainDrawPixel(canvas_.queue, list, {.X = 9, .Y = 9}).value();
  ASSERT_EQ(found.Triangles.size(), 2u);
  const ExplainedTriangle& first = found.Triangles[0];
  EXPECT_TRUE(first.StencilTested && first.StencilPassed);
  EXPECT_EQ(first.StoredStencil, 5);
  EXPECT_EQ(first.Outcome, TriangleOutcome::kWritten);
  const ExplainedTriangle& second = found.Triangles[1];
  EXPECT_TRUE(second.StencilTested && second.TestedLate);
  EXPECT_FALSE(second.StencilPassed || second.DepthTested || second.DepthWritten);
  EXPECT_EQ(second.StoredStencil, 6);
  EXPECT_EQ(second.Outcome, TriangleOutcome::kFailedStencil);
  const std::string text = ToText(found);
  EXPECT_NE(text.find("failed the stencil test"), std::string::npos) << text;
  EXPECT_NE(text.find("stencil 6 after the pixel shader: failed"), std::string::npos) << text;
  EXPECT_NE(text.find("stencil 5 before the pixel shader: passed"), std::string::npos) << text;
  EXPECT_NE(ToJson(found).find("stencil_test"), std::string::npos);
}

TEST_F(ExplainDraws, JsonNamesTheSame) {
  CommandList list = five_draws();
  const std::string json =
      ToJson(ExplainDrawPixel(canvas_.queue, list, {.Draws = {4, 1}, .X = 17, .Y = 4}).value());
  for (const char* part :
       {R"("draw": 4)", R"("func": "LESS")", R"("late": true)", R"("outcome": "written")",
        R"("name": "SV_Target0")", R"("after": "0 0 1 0.25")", R"("draws": 1)"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
  }
}

// The next pixel is kept by the checkerboard: depth 0.5 is stored after the shader.
TEST_F(ExplainDraws, AnotherPixelHasAnotherStory) {
  CommandList list = five_draws();
  const DrawPixelExplanation found =
      ExplainDrawPixel(canvas_.queue, list, {.Draws = {2, 1}, .X = 16, .Y = 4}).value();
  ASSERT_EQ(found.Triangles.size(), 1u);
  const ExplainedTriangle& t = found.Triangles[0];
  EXPECT_EQ(t.Outcome, TriangleOutcome::kWritten);
  EXPECT_FALSE(t.TestedLate);
  EXPECT_TRUE(t.DepthWritten);
  EXPECT_EQ(t.StoredDepth, 0.75f);
  ASSERT_EQ(t.Outputs.size(), 1u);
  // d(xy)/dx in row 4, d(xy)/dy in column 16, coarse as fine.
  EXPECT_EQ(t.Outputs[0].Text, "4.5 16.5 4.5 1");
  EXPECT_EQ(t.Outputs[0].Type, "float4");
}

// Draws leave the same whether they are observed or not.
TEST_F(ExplainDraws, PicturesAreTheSame) {
  CommandList plain = five_draws();
  canvas_.queue.ExecuteAndWait(plain).value();
  canvas_.read_back();
  std::vector<float> expected;
  const auto picture = [&] {
    std::vector<float> out;
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) {
        for (uint32_t c = 0; c < 4; ++c) out.push_back(canvas_.texel<float>(x, y, c));
        out.push_back(canvas_.depth(x, y));
      }
    }
    return out;
  };
  expected = picture();
  EXPECT_EQ(expected[0 + 4], 0.25f);
  CommandList counted = five_draws();
  CollectOverdraw(canvas_.queue, counted).value();
  canvas_.read_back();
  EXPECT_EQ(picture(), expected);
  CommandList explained = five_draws();
  ExplainDrawPixel(canvas_.queue, explained, {.X = 17, .Y = 4}).value();
  canvas_.read_back();
  EXPECT_EQ(picture(), expected);
}

// Covered by all but the culled one; draw 1 fails everywhere before it is shaded; half of draw 2 is
// discarded; draw 4 discards where x > 32.
TEST_F(ExplainDraws, OverdrawCountsEachPixel) {
  CommandList list = five_draws();
  const OverdrawStatistics counts = CollectOverdraw(canvas_.queue, list).value();
  ASSERT_EQ(counts.Width, kSize);
  ASSERT_EQ(counts.Height, kSize);
  ASSERT_EQ(counts.Pixels.size(), size_t{kSize} * kSize);
  EXPECT_EQ(counts.Draws, 5u);
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const PixelOverdraw& pixel = counts.Pixels[size_t{y} * kSize + x];
      ASSERT_EQ(pixel.Covered, 4u);
      ASSERT_EQ(pixel.Shaded, 3u);
      const uint32_t expected = 1 + ((x + y) % 2 == 0 ? 1 : 0) + (x < 32 ? 1 : 0);
      ASSERT_EQ(pixel.Written, expected) << x << ", " << y;
    }
  }
}

// Scissor, a draw without a pixel shader, and a part of the list.
TEST_F(ExplainDraws, OverdrawOfSomeDraws) {
  CommandList list = canvas_.list([&](CommandList& commands) {
    draw(commands, desc("Constant"), {1, 0, 0, 0.75f});
    commands.RSSetScissorRects(Rect{7, 5, 40, 9});
    draw(commands, desc(""), {1, 0, 0, 0.5f});
    draw(commands, desc(""), {1, 0, 0, 0.625f});
  });
  const OverdrawStatistics counts =
      CollectOverdraw(canvas_.queue, list, {.FirstDraw = 1, .DrawCount = 2}).value();
  EXPECT_EQ(counts.Draws, 2u);
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const PixelOverdraw& pixel = counts.Pixels[size_t{y} * kSize + x];
      const bool inside = x >= 7 && x < 40 && y >= 5 && y < 9;
      ASSERT_EQ(pixel.Covered, inside ? 2u : 0u);
      ASSERT_EQ(pixel.Shaded, 0u);
      ASSERT_EQ(pixel.Written, inside ? 1u : 0u);
    }
  }
}

TEST_F(ExplainDraws, DrawsWithoutTargetsAreLeftOut) {
  CommandList list = canvas_.list([&](CommandList& commands) {
    GraphicsPipelineStateDesc counts = desc("Counted");
    counts.DepthStencilState.DepthEnable = false;
    commands.OMSetRenderTargets(0, nullptr, false, nullptr);
    draw(commands, counts, {});
  });
  const OverdrawStatistics counts = CollectOverdraw(canvas_.queue, list).value();
  EXPECT_EQ(counts.Draws, 0u);
  EXPECT_EQ(counts.DrawsLeftOut, 1u);
  EXPECT_EQ(counts.Width, 0u);
  EXPECT_TRUE(counts.Pixels.empty());
}

TEST_F(ExplainDraws, RefusesWhatIsNotThere) {
  CommandList list = five_draws();
  const auto outside = ExplainDrawPixel(canvas_.queue, list, {.X = 64, .Y = 4});
  ASSERT_FALSE(outside.ok());
  EXPECT_NE(outside.error().message.find("outside of the targets (64 x 64)"), std::string::npos);
  const auto none = ExplainDrawPixel(canvas_.queue, list, {.Draws = {5}, .X = 4, .Y = 4});
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("the list has 5 draws"), std::string::npos);
}

// A GPU does not tell. [explain_draw.h]
TEST(ExplainDrawsOnVulkan, IsRefused) {
  KAAMOS_NEED_VULKAN();
  Canvas canvas("vulkan");
  CommandList list = canvas.list([](CommandList&) {});
  const auto counts = CollectOverdraw(canvas.queue, list);
  ASSERT_FALSE(counts.ok());
  EXPECT_EQ(counts.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(counts.error().message.find("use the embree backend"), std::string::npos);
}

}  // namespace
}  // namespace kaamos::draws
