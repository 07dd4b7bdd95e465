// SPDX-License-Identifier: MIT
#include "effects/surfaces/gbuffer/raster_gbuffer.h"

#include <shaders/raster.h>
#include <shaders/resolve.h>

#include <cstddef>

#include "effects/engine/picture.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr Format kVisibilityFormat = Format::kR32G32Uint;
constexpr ResourceStates kReadState = ResourceStates::kNonPixelShaderResource;

// Mirrors DrawConstants of draws.hlsli.
struct DrawConstants {
  std::uint32_t draw = 0;
  float clip_scale = 0;
  glm::vec2 size{0.0f};
};
constexpr std::uint32_t kDrawWord = offsetof(DrawConstants, draw) / 4;

DrawConstants draw_constants(const Frame& frame, float clip_scale) {
  return {0, clip_scale, {frame.width(), frame.height()}};
}

}  // namespace

rtapi::Result<ShaderLibrary> raster_library() {
  return LoadShaderLibrary(kaamos_shaders_raster());
}

rtapi::Result<ShaderLibrary> resolve_library() {
  return LoadShaderLibrary(kaamos_shaders_resolve());
}

rtapi::Result<RasterGBuffer> RasterGBuffer::create(const Device& device, const Frame& frame,
                                                   const Scene& scene, const GpuScene& gpu,
                                                   const RasterLibraries& libraries) {
  RasterGBuffer out;
  out.clip_depth_ = ClipDepth(scene);
  if (const auto s = out.create_targets(device, frame); !s) return s.error();
  const auto pipeline = ScenePipeline::create(
      device, frame,
      {.library = libraries.raster,
       .vertex_shader = "SceneVertex",
       .vertex_shader_of_holes = "SceneVertexWithHoles",
       .pixel_shader = "VisibleTriangle",
       .pixel_shader_of_holes = "VisibleTriangleWithHoles",
       .depth_func = ComparisonFunc::kGreater,  // reversed: the nearest is largest
       .targets = {kVisibilityFormat},
       .name = "visible triangle"});
  if (!pipeline) return pipeline.error();
  out.pipeline_ = *pipeline;
  const auto resolve = ComputePass::create(device, frame, libraries.resolve, "ResolveVisibility");
  if (!resolve) return resolve.error();
  out.resolve_ = *resolve;
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  out.views_ = *views;
  if (const auto s = out.draws_.create(device, scene, gpu, out.views_, {}, "visibility"); !s) {
    return s.error();
  }
  if (const auto s = out.views_.set_shader_resource(2, out.visibility_); !s) return s.error();
  return out;
}

rtapi::Status RasterGBuffer::create_targets(const Device& device, const Frame& frame) {
  TextureDesc desc;
  desc.Width = frame.width();
  desc.Height = frame.height();
  desc.Format = kVisibilityFormat;
  desc.Flags = ResourceFlags::kAllowRenderTarget;
  desc.InitialState = kReadState;
  desc.Name = "visibility";
  const auto visibility = device.CreateTexture(desc);
  if (!visibility) return visibility.error();
  visibility_ = *visibility;
  desc.Format = Format::kR32Typeless;  // drawn as D32_FLOAT, read as R32_FLOAT
  desc.Flags = ResourceFlags::kAllowDepthStencil;
  desc.Name = "raster depth";
  const auto depth = device.CreateTexture(desc);
  if (!depth) return depth.error();
  depth_ = *depth;

  const auto render_targets =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1});
  if (!render_targets) return render_targets.error();
  render_targets_ = *render_targets;
  const auto depth_targets =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1});
  if (!depth_targets) return depth_targets.error();
  depth_targets_ = *depth_targets;
  const auto target_view =
      device.CreateRenderTargetView(visibility_, render_targets_.GetCPUDescriptorHandle(0));
  if (!target_view) return target_view;
  DepthStencilViewDesc depth_view;
  depth_view.Format = Format::kD32Float;
  return device.CreateDepthStencilView(depth_, depth_view,
                                       depth_targets_.GetCPUDescriptorHandle(0));
}

void RasterGBuffer::record_draws(CommandList& list, const Frame& frame, const Camera& camera) {
  draws_.see_instances(kMaskSolid);
  clip_scale_ = clip_depth_.scale_of(camera);

  list.BeginEvent("visibility buffer");
  const ResourceBarrier to_targets[] = {
      ResourceBarrier::Transition(visibility_, kReadState, ResourceStates::kRenderTarget),
      ResourceBarrier::Transition(depth_, kReadState, ResourceStates::kDepthWrite)};
  list.ResourceBarrier(to_targets);
  const CpuDescriptorHandle target = render_targets_.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle depth_target = depth_targets_.GetCPUDescriptorHandle(0);
  list.OMSetRenderTargets(1, &target, false, &depth_target);
  set_draw_area(list, 0, 0, frame.width(), frame.height());
  const float nothing[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(target, nothing);
  list.ClearDepthStencilView(depth_target, ClearFlags::kDepth, 0, 0);  // infinitely far away
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  frame.bind_draws(list, PassArguments(views_, draw_constants(frame, clip_scale_)));
  pipeline_.record(list, draws_, kDrawWord);
  const ResourceBarrier to_read[] = {
      ResourceBarrier::Transition(visibility_, ResourceStates::kRenderTarget, kReadState),
      ResourceBarrier::Transition(depth_, ResourceStates::kDepthWrite, kReadState)};
  list.ResourceBarrier(to_read);
  list.EndEvent();
}

void RasterGBuffer::record_resolve(CommandList& list, const Frame& frame) const {
  resolve_.dispatch(list, frame, {}, PassArguments(views_, draw_constants(frame, clip_scale_)),
                    frame.width(), frame.height());
}

std::uint64_t RasterGBuffer::bytes() const {
  const std::uint64_t pixels = picture_bytes(visibility_) / 8;
  return pixels * (8 + 4) + draws_.bytes();
}

}  // namespace kaamos::effects
