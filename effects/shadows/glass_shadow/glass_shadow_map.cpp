// SPDX-License-Identifier: MIT
#include "effects/shadows/glass_shadow/glass_shadow_map.h"

#include <shaders/glass_shadow_map.h>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/engine/scene_pipeline.h"
#include "effects/shadows/shadow_map/sun_maps.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr ResourceStates kReadState = ResourceStates::kNonPixelShaderResource;
constexpr std::uint32_t kDrawWord = offsetof(ShadowMapConstants, draw) / 4;
constexpr std::uint32_t kColors = 5;  // and depths behind it: registers t of space3
constexpr std::uint32_t kTargets = 2;
constexpr Format kFormats[kTargets] = {Format::kR32G32B32A32Float, Format::kR32Float};

// Colours multiply, so that the order of panes does not count; of depths the smallest stays.
BlendDesc pane_blend() {
  BlendDesc blend;
  blend.IndependentBlendEnable = true;
  RenderTargetBlendDesc& color = blend.RenderTarget[0];
  color.BlendEnable = true;
  color.SrcBlend = Blend::kZero;
  color.DestBlend = Blend::kSrcColor;
  color.SrcBlendAlpha = Blend::kZero;
  color.DestBlendAlpha = Blend::kSrcAlpha;
  RenderTargetBlendDesc& depth = blend.RenderTarget[1];
  depth.BlendEnable = true;
  depth.DestBlend = Blend::kOne;
  depth.BlendOp = BlendOp::kMin;
  depth.DestBlendAlpha = Blend::kOne;
  depth.BlendOpAlpha = BlendOp::kMin;
  return blend;
}

class GlassShadowMap : public EffectPass {
 public:
  explicit GlassShadowMap(const EffectScope& scope)
      : frame_(scope.frame),
        scene_(scope.scene),
        views_(scope.views),
        made_(scope.settings.get_constants<GlassShadowMapConstants>()) {}

  rtapi::Status create(const EffectScope& scope) {
    if (const auto s = check_shadow_map(made_.map); !s) return s;
    boxes_ = instance_boxes(scope.scene);
    const ShaderLibrary& library = scope.library("shadows/glass_shadow/glass_shadow_map");
    if (const auto s = create_targets(scope.device); !s) return s;
    if (const auto s = create_pipeline(scope.device, library); !s) return s;
    const auto drawn = draws_.create(scope.device, scene_, scope.gpu, views_, {}, "map of glass");
    if (!drawn) return drawn;
    const auto place = CreateUploadBuffer(scope.device, std::vector<SunMap>(1), "place of the map");
    if (!place) return place.error();
    place_ = *place;
    if (const auto s = views_.set_shader_resource(2, place_, sizeof(SunMap)); !s) return s;
    const auto disk = bind_disk(scope);
    if (!disk) return disk.error();
    disk_ = *disk;
    const auto look_up = ComputePass::create(scope.device, frame_, library, "GlassMapLookup");
    if (!look_up) return look_up.error();
    look_up_ = *look_up;
    return {};
  }

  // The map lies around all glass: elsewhere there is nothing to look up.
  rtapi::Status begin_frame(const Camera& camera) override {
    draws_.see_instances(kMaskTransparent);
    Bounds bounds;
    for (const SceneDraw& draw : draws_.draws()) {
      const Bounds box = draw_box(draw, boxes_[draw.instance]);
      if (box.empty()) continue;
      bounds.add(camera.position() + box.min);
      bounds.add(camera.position() + box.max);
    }
    SunMapsDesc desc = describe_sun_maps(made_.map, scene_, bounds, frame_);
    desc.cascades = 0;
    place_.data<SunMap>()[0] = sun_maps(desc, camera).front();
    return {};
  }

  void record(CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    auto own = settings.get_constants<GlassShadowMapConstants>();
    own.map.size = made_.map.size;
    own.map.cascades = 1;
    const PassArguments arguments(views_, own);
    list.BeginEvent("map of glass");
    std::vector<ResourceBarrier> barriers;
    for (const Texture& map : maps_) {
      barriers.push_back(
          ResourceBarrier::Transition(map, kReadState, ResourceStates::kRenderTarget));
    }
    list.ResourceBarrier(barriers);
    const CpuDescriptorHandle targets[kTargets] = {targets_.GetCPUDescriptorHandle(0),
                                                   targets_.GetCPUDescriptorHandle(1)};
    list.OMSetRenderTargets(kTargets, targets, false, nullptr);
    set_draw_area(list, 0, 0, made_.map.size, made_.map.size);
    constexpr float kFar = std::numeric_limits<float>::max();
    const float open[4] = {1, 1, 1, 1}, far[4] = {kFar, kFar, kFar, kFar};
    list.ClearRenderTargetView(targets[0], open);
    list.ClearRenderTargetView(targets[1], far);
    list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
    list.SetPipelineState(pipeline_);
    frame_.bind_draws(list, arguments);
    for (std::uint32_t i = 0; i < draws_.draws().size(); ++i) draws_.record(list, i, kDrawWord);
    for (ResourceBarrier& barrier : barriers) std::swap(barrier.StateBefore, barrier.StateAfter);
    list.ResourceBarrier(barriers);
    list.EndEvent();
    look_up_.dispatch(list, frame_, constants, arguments, frame_.width(), frame_.height());
  }

  std::uint64_t bytes() const override {
    return std::uint64_t{made_.map.size} * made_.map.size * 20 + draws_.bytes() + place_.size() +
           disk_.size();
  }

 private:
  rtapi::Status create_targets(const Device& device) {
    const auto heap =
        device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = kTargets});
    if (!heap) return heap.error();
    targets_ = *heap;
    for (std::uint32_t i = 0; i < kTargets; ++i) {
      TextureDesc desc;
      desc.Width = made_.map.size;
      desc.Height = made_.map.size;
      desc.Format = kFormats[i];
      desc.Flags = ResourceFlags::kAllowRenderTarget;
      desc.InitialState = kReadState;
      desc.Name = i == 0 ? "colours of panes" : "depths of panes";
      const auto map = device.CreateTexture(desc);
      if (!map) return map.error();
      maps_[i] = *map;
      const auto view = device.CreateRenderTargetView(*map, targets_.GetCPUDescriptorHandle(i));
      if (!view) return view;
      if (const auto s = views_.set_shader_resource(kColors + i, *map); !s) return s;
    }
    return {};
  }

  rtapi::Status create_pipeline(const Device& device, const ShaderLibrary& library) {
    GraphicsPipelineStateDesc desc;
    desc.pRootSignature = frame_.root_signature();
    desc.VS = {library, "GlassMapVertex"};
    desc.PS = {library, "GlassMapPixel"};
    desc.InputLayout = scene_input_layout();
    desc.RasterizerState.CullMode = CullMode::kNone;  // rays hit both sides, too
    desc.DepthStencilState.DepthEnable = false;
    desc.BlendState = pane_blend();
    desc.RTVFormats = {kFormats[0], kFormats[1]};
    desc.Name = "map of glass";
    const auto created = device.CreateGraphicsPipelineState(desc);
    if (!created) return created.error();
    pipeline_ = *created;
    return {};
  }

  const Frame& frame_;
  const Scene& scene_;
  PassViews& views_;
  const GlassShadowMapConstants made_;
  std::vector<Bounds> boxes_;  // by instance, object space
  Texture maps_[kTargets];     // colours, depths
  DescriptorHeap targets_;
  PipelineState pipeline_;
  SceneDrawList draws_;
  rtapi::Buffer place_, disk_;
  ComputePass look_up_;
};

}  // namespace

rtapi::Result<ShaderLibrary> glass_shadow_map_library() {
  return LoadShaderLibrary(kaamos_shaders_glass_shadow_map());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_glass_shadow_map(const EffectScope& scope) {
  return make_pass<GlassShadowMap>(scope);
}

}  // namespace kaamos::effects
