// SPDX-License-Identifier: MIT
#include "effects/particles/particles.h"

#include <shaders/particles.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/engine/picture.h"
#include "effects/engine/scene_draws.h"
#include "effects/engine/scene_pipeline.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr Format kDrawnFormat = Format::kR32G32B32A32Float;
constexpr ResourceStates kReadState = ResourceStates::kNonPixelShaderResource;
constexpr std::uint32_t kParticles = 0, kDrawn = 1;  // registers t of space3

// Mirrors Particle of particles.hlsl.
struct GpuParticle {
  glm::vec3 position{0.0f};
  float radius = 0;
  glm::vec3 radiance{0.0f};
  float opacity = 0;
};
static_assert(sizeof(GpuParticle) == 32);

// Mirrors ParticleConstants of particles.hlsl.
struct ParticleConstants {
  glm::vec2 size{0.0f};
  float clip_scale = 0;
};

class Particles : public EffectPass {
 public:
  explicit Particles(const EffectScope& scope) : frame_(scope.frame), scene_(scope.scene) {}

  rtapi::Status create(const EffectScope& scope) {
    const ShaderLibrary& library = scope.library("particles/particles");
    auto result = ComputePass::create(scope.device, frame_, library, "ParticlesResult");
    if (!result) return result.error();
    result_ = std::move(*result);
    views_ = &scope.views;
    clip_depth_ = ClipDepth(scene_);
    const std::vector<GpuParticle> room(std::max<std::size_t>(scene_.particles.size(), 1));
    const auto buffer = CreateUploadBuffer(scope.device, room, "particles");
    if (!buffer) return buffer.error();
    particles_ = *buffer;
    const auto s = views_->set_shader_resource(kParticles, particles_, sizeof(GpuParticle));
    if (!s) return s;
    if (const auto t = create_target(scope.device); !t) return t;
    return create_pipeline(scope.device, library);
  }

  rtapi::Status begin_frame(const Camera& camera) override;
  void record(CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override;
  std::uint64_t bytes() const override { return picture_bytes(drawn_) + particles_.size(); }

 private:
  rtapi::Status create_target(const Device& device);
  rtapi::Status create_pipeline(const Device& device, const ShaderLibrary& library);

  const Frame& frame_;
  const Scene& scene_;
  PassViews* views_ = nullptr;
  Buffer particles_;
  Texture drawn_;
  DescriptorHeap targets_;
  PipelineState pipeline_;
  ComputePass result_;
  ClipDepth clip_depth_;
  ParticleConstants constants_;
};

rtapi::Status Particles::create_target(const Device& device) {
  const auto targets =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1});
  if (!targets) return targets.error();
  targets_ = *targets;
  TextureDesc desc;
  desc.Width = frame_.width();
  desc.Height = frame_.height();
  desc.Format = kDrawnFormat;
  desc.Flags = ResourceFlags::kAllowRenderTarget;
  desc.InitialState = kReadState;
  desc.Name = "drawn particles";
  const auto drawn = device.CreateTexture(desc);
  if (!drawn) return drawn.error();
  drawn_ = *drawn;
  const auto view = device.CreateRenderTargetView(drawn_, targets_.GetCPUDescriptorHandle(0));
  if (!view) return view;
  return views_->set_shader_resource(kDrawn, drawn_);
}

rtapi::Status Particles::create_pipeline(const Device& device, const ShaderLibrary& library) {
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = frame_.root_signature();
  desc.VS = {library, "ParticleCorner"};
  desc.PS = {library, "ParticleLight"};
  desc.RasterizerState.CullMode = CullMode::kNone;
  desc.DepthStencilState.DepthEnable = false;  // the shader compares with the G-buffer
  // Light is added to the part of what is behind that is not hidden.
  RenderTargetBlendDesc& blend = desc.BlendState.RenderTarget[0];
  blend.BlendEnable = true;
  blend.DestBlend = Blend::kInvSrcAlpha;
  blend.DestBlendAlpha = Blend::kInvSrcAlpha;
  desc.RTVFormats = {kDrawnFormat};
  desc.Name = "particles";
  const auto created = device.CreateGraphicsPipelineState(desc);
  if (!created) return created.error();
  pipeline_ = *created;
  return {};
}

rtapi::Status Particles::begin_frame(const Camera& camera) {
  constants_ = {.size = glm::vec2(frame_.width(), frame_.height()),
                .clip_scale = clip_depth_.scale_of(camera)};
  std::vector<Particle> sorted = scene_.particles;
  const auto depth = [&](const Particle& particle) {
    return glm::dot(particle.position - camera.position(), camera.forward());
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Particle& a, const Particle& b) { return depth(a) > depth(b); });
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Particle& particle = sorted[i];
    particles_.data<GpuParticle>()[i] = {
        .position = glm::vec3(particle.position - camera.position()),
        .radius = particle.radius,
        .radiance = particle.radiance,
        .opacity = particle.opacity};
  }
  return {};
}

void Particles::record(CommandList& list, const EffectSettings& /*settings*/,
                       const PassConstants& constants) {
  const PassArguments arguments(*views_, constants_);
  list.BeginEvent("particles");
  list.ResourceBarrier(
      ResourceBarrier::Transition(drawn_, kReadState, ResourceStates::kRenderTarget));
  const CpuDescriptorHandle target = targets_.GetCPUDescriptorHandle(0);
  list.OMSetRenderTargets(1, &target, false, nullptr);
  set_draw_area(list, 0, 0, frame_.width(), frame_.height());
  const float nothing[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(target, nothing);
  frame_.bind_draws(list, arguments);
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.SetPipelineState(pipeline_);
  if (!scene_.particles.empty()) {
    list.DrawInstanced(6, static_cast<std::uint32_t>(scene_.particles.size()), 0, 0);
  }
  list.ResourceBarrier(
      ResourceBarrier::Transition(drawn_, ResourceStates::kRenderTarget, kReadState));
  list.EndEvent();
  result_.dispatch(list, frame_, constants, arguments, frame_.width(), frame_.height());
}

}  // namespace

Effect particles_row() {
  Effect row = {.name = "particles", .about = "sparks and smoke, drawn over the frame"};
  row.library = {"particles/particles", particles_library};
  row.make = make_particles;
  row.compose = "ParticlesCompose";
  row.signals = {{.name = "particles", .is_sum = false, .is_light = true}};
  row.needs.particles = true;
  row.on_request = true;
  row.misses = "shadows; glass in front of them; rays do not meet them";
  return row;
}

rtapi::Result<ShaderLibrary> particles_library() {
  return LoadShaderLibrary(kaamos_shaders_particles());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_particles(const EffectScope& scope) {
  return make_pass<Particles>(scope);
}

}  // namespace kaamos::effects
