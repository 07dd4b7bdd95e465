// SPDX-License-Identifier: MIT
#include "effects/reflections/planar/mirrored_draws.h"

#include <array>
#include <cstddef>
#include <utility>

#include "effects/engine/picture.h"
#include "effects/reflections/planar/planar_reflections.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr std::uint32_t kDraws = 7, kGeometries = 8, kVisibility = 9;  // register t, space3
constexpr std::uint32_t kDrawWord = offsetof(PlanarConstants, draw) / 4;
constexpr ResourceStates kReadState = ResourceStates::kNonPixelShaderResource;
constexpr Format kVisibilityFormat = Format::kR32G32Uint;

}  // namespace

rtapi::Result<MirroredDraws> MirroredDraws::create(const EffectScope& scope,
                                                   const ShaderLibrary& library,
                                                   std::uint32_t width, std::uint32_t height) {
  MirroredDraws out;
  out.width_ = width;
  out.height_ = height;
  out.clip_depth_ = ClipDepth(scope.scene);
  auto pipeline = ScenePipeline::create(scope.device, scope.frame,
                                        {.library = library,
                                         .vertex_shader = "MirroredVertex",
                                         .vertex_shader_of_holes = "MirroredVertexWithHoles",
                                         .pixel_shader = "MirroredTriangle",
                                         .pixel_shader_of_holes = "MirroredTriangleWithHoles",
                                         .depth_func = ComparisonFunc::kGreater,  // reversed
                                         .targets = {kVisibilityFormat},
                                         .name = "mirrored triangles"});
  if (!pipeline) return pipeline.error();
  out.pipeline_ = std::move(*pipeline);
  if (const auto s = out.create_targets(scope.device); !s) return s.error();
  const auto drawn = out.draws_.create(scope.device, scope.scene, scope.gpu, scope.views,
                                       {.draws = kDraws, .geometries = kGeometries}, "mirrored");
  if (!drawn) return drawn.error();
  if (const auto s = scope.views.set_shader_resource(kVisibility, out.visibility_); !s) {
    return s.error();
  }
  return out;
}

rtapi::Status MirroredDraws::create_targets(const Device& device) {
  TextureDesc desc;
  desc.Width = width_;
  desc.Height = height_;
  desc.Format = kVisibilityFormat;
  desc.Flags = ResourceFlags::kAllowRenderTarget;
  desc.InitialState = kReadState;
  desc.Name = "mirrored visibility";
  const auto visibility = device.CreateTexture(desc);
  if (!visibility) return visibility.error();
  visibility_ = *visibility;
  desc.Format = Format::kR32Typeless;  // drawn as D32_FLOAT
  desc.Flags = ResourceFlags::kAllowDepthStencil;
  desc.Name = "mirrored depth";
  const auto depth = device.CreateTexture(desc);
  if (!depth) return depth.error();
  depth_ = *depth;
  const auto targets =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1});
  if (!targets) return targets.error();
  target_heap_ = *targets;
  const auto depths =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1});
  if (!depths) return depths.error();
  depth_heap_ = *depths;
  const auto view =
      device.CreateRenderTargetView(visibility_, target_heap_.GetCPUDescriptorHandle(0));
  if (!view) return view;
  DepthStencilViewDesc depth_view;
  depth_view.Format = Format::kD32Float;
  return device.CreateDepthStencilView(depth_, depth_view, depth_heap_.GetCPUDescriptorHandle(0));
}

void MirroredDraws::begin_frame(const Camera& camera) {
  draws_.see_instances(kMaskSolid);
  clip_scale_ = clip_depth_.scale_of(camera);
}

void MirroredDraws::record(CommandList& list, const Frame& frame,
                           const PassArguments& arguments) const {
  list.BeginEvent("mirrored triangles");
  std::array<ResourceBarrier, 2> barriers = {
      ResourceBarrier::Transition(visibility_, kReadState, ResourceStates::kRenderTarget),
      ResourceBarrier::Transition(depth_, kReadState, ResourceStates::kDepthWrite)};
  list.ResourceBarrier(barriers);
  const CpuDescriptorHandle target = target_heap_.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle depth = depth_heap_.GetCPUDescriptorHandle(0);
  list.OMSetRenderTargets(1, &target, false, &depth);
  set_draw_area(list, 0, 0, width_, height_);
  const float nothing[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(target, nothing);
  list.ClearDepthStencilView(depth, ClearFlags::kDepth, 0, 0);  // infinitely far away
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  frame.bind_draws(list, arguments);
  pipeline_.record(list, draws_, kDrawWord);
  for (ResourceBarrier& barrier : barriers) {
    std::swap(barrier.StateBefore, barrier.StateAfter);
  }
  list.ResourceBarrier(barriers);
  list.EndEvent();
}

std::uint64_t MirroredDraws::bytes() const {
  const std::uint64_t texels = std::uint64_t{width_} * height_;
  return texels * (8 + 4) + draws_.bytes();
}

}  // namespace kaamos::effects
