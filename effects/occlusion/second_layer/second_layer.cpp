// SPDX-License-Identifier: MIT
#include "effects/occlusion/second_layer/second_layer.h"

#include <shaders/second_layer.h>

#include <cstddef>
#include <utility>

#include "effects/engine/picture.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr ResourceStates kReadState = ResourceStates::kNonPixelShaderResource;
constexpr std::uint32_t kSecondViewZ = 4;  // register t, space3

// Mirrors DrawConstants of second_layer.hlsl.
struct DrawConstants {
  std::uint32_t draw = 0;
  float clip_scale = 0;
  glm::vec2 size{0.0f};
  float separation = 0;
};
constexpr std::uint32_t kDrawWord = offsetof(DrawConstants, draw) / 4;

}  // namespace

rtapi::Result<ShaderLibrary> second_layer_library() {
  return LoadShaderLibrary(kaamos_shaders_second_layer());
}

rtapi::Result<SecondLayer> SecondLayer::create(const EffectScope& scope,
                                               const ShaderLibrary& library) {
  SecondLayer out;
  out.frame_ = &scope.frame;
  out.views_ = &scope.views;
  out.clip_depth_ = ClipDepth(scope.scene);
  if (const auto s = out.create_targets(scope.device); !s) return s.error();
  auto pipeline =
      ScenePipeline::create(scope.device, scope.frame,
                            {.library = library,
                             .vertex_shader = "SecondLayerVertex",
                             .vertex_shader_of_holes = "SecondLayerHoleVertex",
                             .pixel_shader = "SecondLayerDepth",
                             .pixel_shader_of_holes = "SecondLayerDepthWithHoles",
                             .depth_func = ComparisonFunc::kGreater,  // the nearest is largest
                             .targets = {Format::kR32Float},
                             .name = "second layer"});
  if (!pipeline) return pipeline.error();
  out.pipeline_ = std::move(*pipeline);
  const auto s =
      out.draws_.create(scope.device, scope.scene, scope.gpu, scope.views, {}, "second layer");
  if (!s) return s.error();
  return out;
}

rtapi::Status SecondLayer::create_targets(const Device& device) {
  TextureDesc desc;
  desc.Width = frame_->width();
  desc.Height = frame_->height();
  desc.Format = Format::kR32Float;
  desc.Flags = ResourceFlags::kAllowRenderTarget;
  desc.InitialState = kReadState;
  desc.Name = "second view depth";
  auto view_z = device.CreateTexture(desc);
  if (!view_z) return view_z.error();
  view_z_ = std::move(*view_z);
  desc.Format = Format::kD32Float;
  desc.Flags = ResourceFlags::kAllowDepthStencil;
  desc.InitialState = ResourceStates::kDepthWrite;
  desc.Name = "depth of the second layer";
  auto depth = device.CreateTexture(desc);
  if (!depth) return depth.error();
  depth_ = std::move(*depth);
  auto render_targets =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1});
  if (!render_targets) return render_targets.error();
  render_targets_ = std::move(*render_targets);
  auto depth_targets =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1});
  if (!depth_targets) return depth_targets.error();
  depth_targets_ = std::move(*depth_targets);
  if (const auto s =
          device.CreateRenderTargetView(view_z_, render_targets_.GetCPUDescriptorHandle(0));
      !s) {
    return s;
  }
  DepthStencilViewDesc view;
  view.Format = Format::kD32Float;
  if (const auto s =
          device.CreateDepthStencilView(depth_, view, depth_targets_.GetCPUDescriptorHandle(0));
      !s) {
    return s;
  }
  return views_->set_shader_resource(kSecondViewZ, view_z_);
}

void SecondLayer::begin_frame(const Camera& camera) {
  draws_.see_instances(kMaskSolid);
  clip_scale_ = clip_depth_.scale_of(camera);
}

void SecondLayer::record(CommandList& list, float separation) const {
  const auto transition = [&](ResourceStates from, ResourceStates to) {
    list.ResourceBarrier(ResourceBarrier::Transition(view_z_, from, to));
  };
  transition(kReadState, ResourceStates::kRenderTarget);
  const CpuDescriptorHandle target = render_targets_.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle depth_target = depth_targets_.GetCPUDescriptorHandle(0);
  list.OMSetRenderTargets(1, &target, false, &depth_target);
  set_draw_area(list, 0, 0, frame_->width(), frame_->height());
  const float nothing[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(target, nothing);
  list.ClearDepthStencilView(depth_target, ClearFlags::kDepth, 0, 0);  // infinitely far away
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  const DrawConstants constants = {0, clip_scale_, {frame_->width(), frame_->height()}, separation};
  frame_->bind_draws(list, PassArguments(*views_, constants));
  pipeline_.record(list, draws_, kDrawWord);
  transition(ResourceStates::kRenderTarget, kReadState);
}

std::uint64_t SecondLayer::bytes() const {
  return picture_bytes(view_z_) + picture_bytes(depth_) + draws_.bytes();
}

}  // namespace kaamos::effects
