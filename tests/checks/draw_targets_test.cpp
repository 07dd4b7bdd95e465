// SPDX-License-Identifier: MIT
//
// Formats, states, sizes and contents of what draws write to.
#include "tests/checks/draw_world.h"

namespace kaamos::checks::test {
namespace {

using namespace rtapi;

class DrawTargets : public DrawWorld {
 protected:
  void transition(CommandList& list, const Texture& texture, ResourceStates before,
                  ResourceStates after) {
    list.ResourceBarrier(ResourceBarrier::Transition(texture, before, after));
  }
  GraphicsPipelineStateDesc testing_only(ComparisonFunc func = ComparisonFunc::kLess) {
    GraphicsPipelineStateDesc out = desc();
    out.DepthStencilState.DepthWriteMask = DepthWriteMask::kZero;
    out.DepthStencilState.DepthFunc = func;
    return out;
  }
  GraphicsPipelineStateDesc blending() {
    GraphicsPipelineStateDesc out = desc();
    auto& blend = out.BlendState.RenderTarget[0];
    blend.BlendEnable = true;
    blend.SrcBlend = Blend::kOne;
    blend.DestBlend = Blend::kOne;
    return out;
  }
};

TEST_F(DrawTargets, Clean) {
  CommandList list = begin();
  draw(list);
  draw(list, testing_only());
  run(list);
  expect_none();
}

TEST_F(DrawTargets, FormatOfATarget) {
  CommandList list = begin();
  const float black[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(rtvs_.GetCPUDescriptorHandle(2), black);
  bind(list, 2);
  draw(list);
  run(list);
  expect_one("KA0443", {"draw 0, pipeline \"plain\": render target 0 is texture \"bytes\"",
                        "viewed as R8G8B8A8_UNORM", "RTVFormats[0]", "R32G32B32A32_FLOAT",
                        "(DrawInstanced, command 3)"});
  CommandList right = begin();
  bind(right, 2);
  GraphicsPipelineStateDesc same = desc();
  same.RTVFormats = {Format::kR8G8B8A8Unorm};
  draw(right, same);
  run(right);
  expect_none();
}

TEST_F(DrawTargets, FormatOfTheDepthBuffer) {
  CommandList list = begin();
  GraphicsPipelineStateDesc other = desc();
  other.DSVFormat = Format::kD16Unorm;
  draw(list, other);
  run(list);
  expect_one("KA0443", {"the depth buffer is texture \"depth\", viewed as D32_FLOAT",
                        "DSVFormat of the pipeline is D16_UNORM"});
}

TEST_F(DrawTargets, DepthTestWithoutADepthBuffer) {
  CommandList list = begin();
  bind(list, 0, -1);
  draw(list);
  run(list);
  expect_one("KA0444", {"DepthEnable is true with LESS", "bound no depth-stencil view"});
  CommandList off = begin();
  bind(off, 0, -1);
  GraphicsPipelineStateDesc none = desc();
  none.DepthStencilState.DepthEnable = false;
  none.DSVFormat = Format::kUnknown;
  draw(off, none);
  run(off);
  expect_none();
}

TEST_F(DrawTargets, WritesThroughAReadOnlyView) {
  CommandList list = begin();
  bind(list, 0, 1);
  draw(list);
  run(list);
  expect_one("KA0445", {"DepthWriteMask is kAll", "texture \"depth\" has kReadOnlyDepth"});
  CommandList tested = begin();
  bind(tested, 0, 1);
  draw(tested, testing_only());
  run(tested);
  expect_none();
}

TEST_F(DrawTargets, StencilTestWithoutStencil) {
  GraphicsPipelineStateDesc tested = desc();
  tested.DepthStencilState.StencilEnable = true;
  CommandList list = begin();
  draw(list, tested);
  run(list);
  expect_one("KA0444",
             {"StencilEnable is true", "texture \"depth\", viewed as D32_FLOAT", "has no stencil"});
  CommandList unbound = begin();
  bind(unbound, 0, -1);
  tested.DepthStencilState.DepthEnable = false;
  draw(unbound, tested);
  run(unbound);
  expect_one("KA0444",
             {"StencilEnable is true", "bound no depth-stencil view", "StencilEnable false"});
}

// Masks that hide a whole draw are what stencil is for.
TEST_F(DrawTargets, StencilOfATarget) {
  const Texture both = texture("both", Format::kR24G8Typeless, ResourceFlags::kAllowDepthStencil,
                               ResourceStates::kDepthWrite);
  DepthStencilViewDesc view;
  const auto bind_both = [&](CommandList& list, DsvFlags flags) {
    view.Flags = flags;
    device_.CreateDepthStencilView(both, view, dsvs_.GetCPUDescriptorHandle(1)).value();
    bind(list, 0, 1);
  };
  GraphicsPipelineStateDesc equal = desc();
  equal.DSVFormat = Format::kD24UnormS8Uint;
  equal.DepthStencilState.DepthEnable = false;
  equal.DepthStencilState.StencilEnable = true;
  equal.DepthStencilState.FrontFace.StencilFunc = ComparisonFunc::kEqual;
  CommandList unwritten = begin();
  bind_both(unwritten, DsvFlags::kNone);
  draw(unwritten, equal);
  run(unwritten);
  expect_one("KA0484", {"the stencil test reads texture \"both\""});
  CommandList hidden = begin();
  bind_both(hidden, DsvFlags::kNone);
  hidden.ClearDepthStencilView(dsvs_.GetCPUDescriptorHandle(1), ClearFlags::kStencil, 0, 1);
  draw(hidden, equal);
  run(hidden);
  expect_none();
  equal.DepthStencilState.FrontFace.StencilPassOp = StencilOp::kIncr;
  CommandList read_only = begin();
  bind_both(read_only, DsvFlags::kReadOnlyStencil);
  draw(read_only, equal);
  run(read_only);
  expect_one("KA0445", {"stencil operations are not all kKeep", "\"both\" has kReadOnlyStencil"});
  CommandList state = begin();
  bind_both(state, DsvFlags::kNone);
  transition(state, both, ResourceStates::kDepthWrite, ResourceStates::kDepthRead);
  draw(state, equal);
  run(state);
  expect_one("KA0451", {"the depth buffer's stencil is in", "of texture \"both\"", "kDepthWrite"});
}

TEST_F(DrawTargets, SizesDiffer) {
  CommandList list = begin();
  const float black[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(rtvs_.GetCPUDescriptorHandle(1), black);
  bind(list, 1);
  draw(list);
  run(list);
  expect_one("KA0446", {"render target 0 is 8 x 8 texels and the depth buffer 16 x 16"});
}

TEST_F(DrawTargets, StateOfATarget) {
  CommandList list = begin();
  transition(list, color_, ResourceStates::kRenderTarget, ResourceStates::kPixelShaderResource);
  draw(list);
  run(list);
  expect_one("KA0451", {"draw 0, pipeline \"plain\": render target 0 is in texture \"color\"",
                        "which is in state kPixelShaderResource since", "kRenderTarget"});
}

TEST_F(DrawTargets, DepthWritesInAStateForReading) {
  CommandList list = begin();
  transition(list, depth_, ResourceStates::kDepthWrite, ResourceStates::kDepthRead);
  draw(list);
  run(list);
  expect_one("KA0451", {"the depth buffer is in texture \"depth\"", "kDepthRead", "kDepthWrite"});
  CommandList back = begin();  // the message put it into kDepthWrite
  transition(back, depth_, ResourceStates::kDepthWrite, ResourceStates::kDepthRead);
  draw(back, testing_only());
  transition(back, depth_, ResourceStates::kDepthRead, ResourceStates::kDepthWrite);
  run(back);
  expect_none();
}

TEST_F(DrawTargets, ClearInAnotherState) {
  CommandList list = device_.CreateCommandList().value();
  transition(list, color_, ResourceStates::kRenderTarget, ResourceStates::kCopySource);
  const float black[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(rtvs_.GetCPUDescriptorHandle(0), black);
  run(list);
  expect_one("KA0451", {"the view to clear is in texture \"color\"", "kCopySource"});
}

TEST_F(DrawTargets, ABoundTargetChangesItsState) {
  CommandList list = begin();
  draw(list);
  transition(list, color_, ResourceStates::kRenderTarget, ResourceStates::kPixelShaderResource);
  draw(list, testing_only(ComparisonFunc::kLessEqual));
  run(list);
  expect_one("KA0487", {"draw 1", "render target 0", "kPixelShaderResource",
                        "Earlier draws of this list wrote to it"});
}

TEST_F(DrawTargets, PixelShadersReadInTheirOwnState) {
  for (const ResourceStates wrong :
       {ResourceStates::kRenderTarget, ResourceStates::kNonPixelShaderResource}) {
    CommandList list = begin();
    transition(list, image_, ResourceStates::kPixelShaderResource, wrong);
    draw(list, desc("Fetched"));
    run(list);
    expect_one("KA0451", {"draw 0, pipeline \"plain\": pixel shader \"Fetched\", t0 \"image\"",
                          "texture \"image\"", "it must be in state kPixelShaderResource"});
  }
  CommandList right = begin();
  draw(right, desc("Fetched"));
  run(right);
  expect_none();
}

TEST_F(DrawTargets, ATargetIsReadByTheDrawThatWritesIt) {
  CommandList list = begin();
  list.SetGraphicsRootDescriptorTable(1, views_.GetGPUDescriptorHandle(1));
  draw(list, desc("Fetched"));
  run(list);
  expect_one("KA0489", {"pixel shader \"Fetched\", t0 \"image\" is a view of texture \"color\"",
                        "render target 0 of the same draw"});
}

// Depth that is only tested may be read at the same time. [RAS-130]
TEST_F(DrawTargets, DepthIsReadWhileItIsTested) {
  const ResourceStates both = ResourceStates::kDepthRead | ResourceStates::kPixelShaderResource;
  CommandList list = begin();
  transition(list, depth_, ResourceStates::kDepthWrite, both);
  bind(list, 0, 1);
  list.SetGraphicsRootDescriptorTable(1, views_.GetGPUDescriptorHandle(2));
  GraphicsPipelineStateDesc reads = testing_only();
  reads.PS.EntryPoint = "Fetched";
  draw(list, reads);
  transition(list, depth_, both, ResourceStates::kDepthWrite);
  run(list);
  expect_none();
  CommandList written = begin();
  written.SetGraphicsRootDescriptorTable(1, views_.GetGPUDescriptorHandle(2));
  draw(written, desc("Fetched"));
  run(written);
  expect_one("KA0489",
             {"texture \"depth\"", "the depth buffer, which is written, of the same draw"});
}

TEST_F(DrawTargets, BlendingReadsWhatNothingWrote) {
  CommandList list = device_.CreateCommandList().value();
  list.ClearDepthStencilView(dsvs_.GetCPUDescriptorHandle(0), ClearFlags::kDepth, 1, 0);
  set_all(list);
  bind(list, 0);
  draw(list, blending());
  run(list);
  expect_one("KA0484", {"blending reads render target 0 texture \"color\"", "nothing has written"});
  CommandList cleared = begin();
  draw(cleared, blending());
  run(cleared);
  expect_none();
}

TEST_F(DrawTargets, TheDepthTestReadsWhatNothingWrote) {
  CommandList list = device_.CreateCommandList().value();
  set_all(list);
  bind(list, 0);
  draw(list, testing_only(ComparisonFunc::kGreater));
  run(list);
  expect_one("KA0484", {"the depth test reads texture \"depth\""});
}

TEST_F(DrawTargets, ClearedToWhatNothingPasses) {
  CommandList list = begin(0);
  draw(list);
  run(list);
  expect_one("KA0459", {"the depth test is LESS", "texture \"depth\" was cleared to 0",
                        "Clear to 1, or use GREATER"});
  CommandList reversed = begin(1);
  draw(reversed, testing_only(ComparisonFunc::kGreaterEqual));
  run(reversed);
  expect_one("KA0459", {"the depth test is GREATER_EQUAL", "was cleared to 1", "Clear to 0"});
  CommandList right = begin(0);
  draw(right, testing_only(ComparisonFunc::kGreater));
  run(right);
  expect_none();
}

TEST_F(DrawTargets, ClearedToAnotherValueThanTheOptimizedOne) {
  const ClearValue best = {.Format = Format::kR8G8B8A8Unorm, .Color = {0, 0.5f, 0, 1}};
  const Texture picture =
      texture("picture", Format::kR8G8B8A8Unorm, ResourceFlags::kAllowRenderTarget,
              ResourceStates::kRenderTarget, kSize, best);
  device_.CreateRenderTargetView(picture, rtvs_.GetCPUDescriptorHandle(2)).value();
  const auto clear = [&](float green) {
    CommandList list = device_.CreateCommandList().value();
    const float color[4] = {0, green, 0, 1};
    list.ClearRenderTargetView(rtvs_.GetCPUDescriptorHandle(2), color);
    run(list);
  };
  clear(0.5f);
  expect_none();
  clear(0.25f);
  expect_one("KA0477",
             {"texture \"picture\" is cleared to 0 0.25 0 1", "OptimizedClearValue is 0 0.5 0 1"});
}

// Always an error, checked or not. [5, 6 of the classes]
TEST_F(DrawTargets, ATargetFreedBeforeTheListRuns) {
  CommandList list = begin();
  draw(list);
  list.Close().value();
  color_ = {};
  const Status status = queue_.ExecuteAndWait(list);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("was a view of texture \"color\", which was freed"),
            std::string::npos)
      << status.error().message;
}

}  // namespace
}  // namespace kaamos::checks::test
