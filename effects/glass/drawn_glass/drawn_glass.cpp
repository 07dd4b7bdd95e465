// SPDX-License-Identifier: MIT
#include "effects/glass/drawn_glass/drawn_glass.h"

#include <shaders/drawn_glass.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "effects/engine/picture.h"
#include "effects/engine/scene_pipeline.h"
#include "effects/reflections/environment_map/environment_map.h"
#include "effects/surfaces/gbuffer/raster_gbuffer.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr Format kDrawnFormat = Format::kR32G32B32A32Float;
constexpr ResourceStates kReadState = ResourceStates::kNonPixelShaderResource;
constexpr std::uint32_t kDrawWord = offsetof(DrawnGlassConstants, draw) / 4;
// Registers of space3.
constexpr std::uint32_t kMirrored = 2, kSun = 3;                          // u
constexpr std::uint32_t kDrawnRadiance = 3, kDraws = 7, kGeometries = 8;  // t
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
  explicit DrawnGlass(const EffectScope& scope)
      : device_(scope.device), frame_(scope.frame), gpu_(scope.gpu), views_(scope.views) {}

  rtapi::Status create(const EffectScope& scope) {
    auto rays =
        RayPass::create(device_, frame_, gpu_,
                        glass_reflection_pass(scope.library("glass/transparent/transparent")));
    if (!rays) return rays.error();
    rays_ = std::move(*rays);
    const ShaderLibrary& library = scope.library("glass/drawn_glass/drawn_glass");
    auto join = ComputePass::create(device_, frame_, library, "DrawnGlassResult");
    if (!join) return join.error();
    join_ = std::move(*join);
    if (const auto s = create_pictures(); !s) return s;
    if (const auto s = create_pipelines(library); !s) return s;
    if (const auto s = create_buffers(scope.scene); !s) return s;
    const auto constants = scope.settings.get_constants<DrawnGlassConstants>();
    auto map =
        EnvironmentFallback::create(scope, constants.fallback == DrawnGlassFallback::kEnvironment);
    if (!map) return map.error();
    environment_ = std::move(*map);
    return {};
  }

  rtapi::Status begin_frame(const Camera& camera) override;
  void record(CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override;
  std::uint64_t bytes() const override;

 private:
  rtapi::Status create_pictures();
  rtapi::Status create_pipelines(const ShaderLibrary& library);
  rtapi::Status create_buffers(const Scene& scene);
  void record_glass(CommandList& list) const;

  const Device& device_;
  const Frame& frame_;
  const GpuScene& gpu_;
  PassViews& views_;
  RayPass rays_;
  ComputePass join_;
  Texture mirrored_, sun_, drawn_[kTargets];
  DescriptorHeap targets_;
  PipelineState sides_[2];           // backs, fronts
  std::vector<glm::dvec3> centres_;  // of meshes, object space
  SceneDrawList draws_;
  EnvironmentFallback environment_;
  ClipDepth clip_depth_;
  float clip_scale_ = 0;
};

rtapi::Status DrawnGlass::create_pictures() {
  struct {
    Texture* picture;
    const char* name;
    std::uint32_t u;
  } const pictures[] = {{&mirrored_, "mirrored by glass", kMirrored},
                        {&sun_, "sun on glass", kSun}};
  for (const auto& each : pictures) {
    const auto created = frame_.create_picture(device_, each.name, kDrawnFormat);
    if (!created) return created.error();
    *each.picture = *created;
    if (const auto s = views_.set_unordered_access(each.u, *created); !s) return s;
  }
  const auto targets =
      device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = kTargets});
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
    const auto created = device_.CreateTexture(desc);
    if (!created) return created.error();
    drawn_[i] = *created;
    const auto view = device_.CreateRenderTargetView(drawn_[i], targets_.GetCPUDescriptorHandle(i));
    if (!view) return view;
    if (const auto s = views_.set_shader_resource(kDrawnRadiance + i, drawn_[i]); !s) return s;
  }
  return {};
}

rtapi::Status DrawnGlass::create_pipelines(const ShaderLibrary& library) {
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = frame_.root_signature();
  desc.VS = {library, "DrawnGlassVertex"};
  desc.PS = {library, "DrawnGlassPixel"};
  desc.InputLayout = {{.SemanticName = "POSITION",
                       .Format = Format::kR32G32B32Float,
                       .AlignedByteOffset = kPositionOffset}};
  desc.RasterizerState.FrontCounterClockwise = true;  // as shapes are
  desc.DepthStencilState.DepthEnable = false;         // shaders compare with the G-buffer
  desc.BlendState = over_blend();
  desc.RTVFormats = {kDrawnFormat, kDrawnFormat};
  for (std::size_t i = 0; i < 2; ++i) {
    desc.RasterizerState.CullMode = i == 0 ? CullMode::kFront : CullMode::kBack;
    desc.Name = i == 0 ? "backs of glass" : "fronts of glass";
    const auto created = device_.CreateGraphicsPipelineState(desc);
    if (!created) return created.error();
    sides_[i] = *created;
  }
  return {};
}

rtapi::Status DrawnGlass::create_buffers(const Scene& scene) {
  clip_depth_ = ClipDepth(scene);
  for (const Instance& instance : scene.instances) {
    const Bounds box = scene.meshes[instance.mesh].bounds();
    centres_.push_back(box.empty() ? glm::dvec3(0.0) : (box.min + box.max) * 0.5);
  }
  return draws_.create(device_, scene, gpu_, views_, {.draws = kDraws, .geometries = kGeometries},
                       "glass");
}

// Far draws come first. What cannot be sorted by the middle of its box is blended in a wrong order.
rtapi::Status DrawnGlass::begin_frame(const Camera& camera) {
  clip_scale_ = clip_depth_.scale_of(camera);
  std::vector<SceneDraw> draws = scene_draws(gpu_, kMaskTransparent);
  const auto distance = [&](const SceneDraw& draw) {
    const glm::dmat3x4 rows(draw.object_to_world);
    const glm::dvec4 centre(centres_[draw.instance], 1.0);
    const glm::dvec3 at(glm::dot(rows[0], centre), glm::dot(rows[1], centre),
                        glm::dot(rows[2], centre));
    return camera.is_orthographic() ? glm::dot(at, camera.forward()) : glm::length(at);
  };
  std::stable_sort(draws.begin(), draws.end(), [&](const SceneDraw& a, const SceneDraw& b) {
    return distance(a) > distance(b);
  });
  draws_.set(std::move(draws));
  return environment_.begin_frame(camera);
}

void DrawnGlass::record_glass(CommandList& list) const {
  for (std::uint32_t i = 0; i < draws_.draws().size(); ++i) {
    draws_.bind(list, i, kDrawWord);
    for (const PipelineState& side : sides_) {
      list.SetPipelineState(side);
      list.DrawIndexedInstanced(draws_.geometry(i).index_count, 1, 0, 0, 0);
    }
  }
}

void DrawnGlass::record(CommandList& list, const EffectSettings& settings,
                        const PassConstants& constants) {
  auto words = settings.get_constants<DrawnGlassConstants>();
  if (!environment_) words.fallback = DrawnGlassFallback::kNothing;
  words.clip_scale = clip_scale_;
  words.width = static_cast<float>(frame_.width());
  words.height = static_cast<float>(frame_.height());
  const PassArguments arguments(views_, words);
  rays_.dispatch(list, frame_, constants, frame_.height(), arguments);
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
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  frame_.bind_draws(list, arguments);
  record_glass(list);
  for (ResourceBarrier& barrier : barriers) {
    std::swap(barrier.StateBefore, barrier.StateAfter);
  }
  list.ResourceBarrier(barriers);
  list.EndEvent();
  join_.dispatch(list, frame_, constants, arguments, frame_.width(), frame_.height());
}

std::uint64_t DrawnGlass::bytes() const {
  return 4 * picture_bytes(mirrored_) + draws_.bytes() + environment_.bytes();
}

}  // namespace

rtapi::Result<ShaderLibrary> drawn_glass_library() {
  return LoadShaderLibrary(kaamos_shaders_drawn_glass());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_drawn_glass(const EffectScope& scope) {
  return make_pass<DrawnGlass>(scope);
}

}  // namespace kaamos::effects
