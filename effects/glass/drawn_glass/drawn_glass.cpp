// SPDX-License-Identifier: MIT
#include "effects/glass/drawn_glass/drawn_glass.h"

#include <shaders/drawn_glass.h>

#include <utility>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/engine/picture.h"
#include "effects/engine/scene_pipeline.h"
#include "effects/glass/drawn_glass/glass_draws.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr Format kDrawnFormat = Format::kR32G32B32A32Float;
constexpr ResourceStates kReadState = ResourceStates::kNonPixelShaderResource;
constexpr std::uint32_t kDrawnRadiance = 3;  // and transmittance behind it: registers t of space3
constexpr std::uint32_t kTargets = 2;

// Layers are drawn over those behind them: their light is added to a part of what is there.
BlendDesc over_blend() {
  BlendDesc blend;
  blend.IndependentBlendEnable = true;
  RenderTargetBlendDesc& radiance = blend.RenderTarget[0];
  radiance.BlendEnable = true;
  radiance.DestBlend = Blend::kInvSrcAlpha;
  radiance.DestBlendAlpha = Blend::kInvSrcAlpha;
  RenderTargetBlendDesc& transmittance = blend.RenderTarget[1];
  transmittance.BlendEnable = true;
  transmittance.SrcBlend = Blend::kZero;
  transmittance.DestBlend = Blend::kSrcColor;
  transmittance.SrcBlendAlpha = Blend::kZero;
  transmittance.DestBlendAlpha = Blend::kSrcAlpha;
  return blend;
}

class DrawnGlass : public EffectPass {
 public:
  explicit DrawnGlass(const EffectScope& scope) : frame_(scope.frame), views_(scope.views) {}

  rtapi::Status create(const EffectScope& scope) {
    const ShaderLibrary& library = scope.library("glass/drawn_glass/drawn_glass");
    auto join = ComputePass::create(scope.device, frame_, library, "DrawnGlassResult");
    if (!join) return join.error();
    join_ = std::move(*join);
    if (const auto s = create_pictures(scope.device); !s) return s;
    const auto constants = scope.settings.get_constants<DrawnGlassConstants>();
    if (const auto s = glass_.create(scope, constants); !s) return s;
    return create_pipelines(scope.device, library);
  }

  rtapi::Status begin_frame(const Camera& camera) override { return glass_.begin_frame(camera); }
  void record(CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override;
  std::uint64_t bytes() const override { return 2 * picture_bytes(drawn_[0]) + glass_.bytes(); }

 private:
  rtapi::Status create_pictures(const Device& device);
  rtapi::Status create_pipelines(const Device& device, const ShaderLibrary& library);

  const Frame& frame_;
  PassViews& views_;
  GlassDraws glass_;
  ComputePass join_;
  Texture drawn_[kTargets];
  DescriptorHeap targets_;
  std::vector<PipelineState> sides_;  // backs, fronts
};

rtapi::Status DrawnGlass::create_pictures(const Device& device) {
  const auto targets =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = kTargets});
  if (!targets) return targets.error();
  targets_ = *targets;
  for (std::uint32_t i = 0; i < kTargets; ++i) {
    TextureDesc desc;
    desc.Width = frame_.width();
    desc.Height = frame_.height();
    desc.Format = kDrawnFormat;
    desc.Flags = ResourceFlags::kAllowRenderTarget;
    desc.InitialState = kReadState;
    desc.Name = i == 0 ? "drawn glass radiance" : "drawn glass transmittance";
    const auto created = device.CreateTexture(desc);
    if (!created) return created.error();
    drawn_[i] = *created;
    const auto view = device.CreateRenderTargetView(drawn_[i], targets_.GetCPUDescriptorHandle(i));
    if (!view) return view;
    if (const auto s = views_.set_shader_resource(kDrawnRadiance + i, drawn_[i]); !s) return s;
  }
  return {};
}

rtapi::Status DrawnGlass::create_pipelines(const Device& device, const ShaderLibrary& library) {
  GraphicsPipelineStateDesc desc = glass_.describe(library, "DrawnGlassPixel");
  desc.DepthStencilState.DepthEnable = false;  // shaders compare with the G-buffer
  desc.BlendState = over_blend();
  desc.RTVFormats = {kDrawnFormat, kDrawnFormat};
  for (const bool is_back : {true, false}) {
    desc.RasterizerState.CullMode = is_back ? CullMode::kFront : CullMode::kBack;
    desc.Name = is_back ? "backs of glass" : "fronts of glass";
    const auto created = device.CreateGraphicsPipelineState(desc);
    if (!created) return created.error();
    sides_.push_back(*created);
  }
  return {};
}

void DrawnGlass::record(CommandList& list, const EffectSettings& settings,
                        const PassConstants& constants) {
  auto words = settings.get_constants<DrawnGlassConstants>();
  glass_.set_words(words);
  const PassArguments arguments(views_, words);
  glass_.record_rays(list, constants, arguments, words);
  list.BeginEvent("drawn glass");
  std::vector<ResourceBarrier> barriers;
  for (const Texture& target : drawn_) {
    barriers.push_back(
        ResourceBarrier::Transition(target, kReadState, ResourceStates::kRenderTarget));
  }
  list.ResourceBarrier(barriers);
  const CpuDescriptorHandle targets[kTargets] = {targets_.GetCPUDescriptorHandle(0),
                                                 targets_.GetCPUDescriptorHandle(1)};
  list.OMSetRenderTargets(kTargets, targets, false, nullptr);
  set_draw_area(list, 0, 0, frame_.width(), frame_.height());
  const float black[4] = {0, 0, 0, 0}, open[4] = {1, 1, 1, 1};
  list.ClearRenderTargetView(targets[0], black);
  list.ClearRenderTargetView(targets[1], open);
  frame_.bind_draws(list, arguments);
  glass_.record(list, sides_);
  for (ResourceBarrier& barrier : barriers) {
    std::swap(barrier.StateBefore, barrier.StateAfter);
  }
  list.ResourceBarrier(barriers);
  list.EndEvent();
  join_.dispatch(list, frame_, constants, arguments, frame_.width(), frame_.height());
}

}  // namespace

rtapi::Result<ShaderLibrary> drawn_glass_library() {
  return LoadShaderLibrary(kaamos_shaders_drawn_glass());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_drawn_glass(const EffectScope& scope) {
  return make_pass<DrawnGlass>(scope);
}

}  // namespace kaamos::effects
