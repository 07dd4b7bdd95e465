// SPDX-License-Identifier: MIT
#include "effects/surfaces/gbuffer/raster_gbuffer.h"

#include <shaders/raster.h>
#include <shaders/resolve.h>

#include <algorithm>

#include "effects/engine/picture.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr Format kVisibilityFormat = Format::kR32G32Uint;
constexpr ResourceStates kReadState = ResourceStates::kNonPixelShaderResource;

// Mirrors DrawConstants of draws.hlsli.
struct DrawConstants {
  std::uint32_t draw = 0;
  float near_plane = 0;
  glm::vec2 size{0.0f};
};

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
  if (const auto s = out.create_targets(device, frame); !s) return s.error();
  if (const auto s = out.create_pipelines(device, frame, libraries.raster); !s) return s.error();
  const auto resolve = ComputePass::create(device, frame, libraries.resolve, "ResolveVisibility");
  if (!resolve) return resolve.error();
  out.resolve_ = *resolve;
  if (const auto s = out.create_buffers(device, frame, scene, gpu); !s) return s.error();
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

rtapi::Status RasterGBuffer::create_pipelines(const Device& device, const Frame& frame,
                                              const ShaderLibrary& library) {
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = frame.root_signature();
  desc.VS = {library, "SceneVertex"};
  desc.InputLayout = {
      {.SemanticName = "POSITION",
       .Format = Format::kR32G32B32Float,
       .AlignedByteOffset = kPositionOffset},
      {.SemanticName = "TEXCOORD", .Format = Format::kR32G32Float, .AlignedByteOffset = kUvOffset}};
  desc.RasterizerState.CullMode = CullMode::kNone;              // rays hit both sides, too
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kGreater;  // reversed: the nearest is largest
  desc.RTVFormats = {kVisibilityFormat};
  desc.DSVFormat = Format::kD32Float;
  const auto create = [&](const char* pixel_shader, PipelineState& pipeline) -> rtapi::Status {
    desc.PS = {library, pixel_shader};
    desc.Name = pixel_shader;
    const auto created = device.CreateGraphicsPipelineState(desc);
    if (!created) return created.error();
    pipeline = *created;
    return {};
  };
  if (const auto s = create("VisibleTriangle", opaque_); !s) return s;
  return create("VisibleTriangleWithHoles", with_holes_);
}

rtapi::Status RasterGBuffer::create_buffers(const Device& device, const Frame& frame,
                                            const Scene& scene, const GpuScene& gpu) {
  const std::vector<SceneDraw> draws(std::max(most_scene_draws(scene), 1u));
  const auto draw_buffer = CreateUploadBuffer(device, draws, "draws");
  if (!draw_buffer) return draw_buffer.error();
  draw_buffer_ = *draw_buffer;
  std::vector<HitConstants> geometries;
  for (const GpuGeometry& geometry : gpu.geometries) geometries.push_back(geometry.constants);
  if (geometries.empty()) geometries.emplace_back();
  const auto geometry_buffer = CreateUploadBuffer(device, geometries, "geometries");
  if (!geometry_buffer) return geometry_buffer.error();
  geometry_buffer_ = *geometry_buffer;
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  views_ = *views;
  if (const auto s = views_.set_shader_resource(0, draw_buffer_, sizeof(SceneDraw)); !s) return s;
  const auto s = views_.set_shader_resource(1, geometry_buffer_, sizeof(HitConstants));
  if (!s) return s;
  return views_.set_shader_resource(2, visibility_);
}

void RasterGBuffer::record_draws(CommandList& list, const Frame& frame, const GpuScene& gpu,
                                 float near_plane) {
  draws_ = scene_draws(gpu);
  std::copy(draws_.begin(), draws_.end(), draw_buffer_.data<SceneDraw>().begin());
  near_plane_ = near_plane * kRasterNearShare;
  const std::uint32_t width = frame.width(), height = frame.height();

  list.BeginEvent("visibility buffer");
  const ResourceBarrier to_targets[] = {
      ResourceBarrier::Transition(visibility_, kReadState, ResourceStates::kRenderTarget),
      ResourceBarrier::Transition(depth_, kReadState, ResourceStates::kDepthWrite)};
  list.ResourceBarrier(to_targets);
  const CpuDescriptorHandle target = render_targets_.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle depth_target = depth_targets_.GetCPUDescriptorHandle(0);
  list.OMSetRenderTargets(1, &target, false, &depth_target);
  list.RSSetViewports(Viewport{0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1});
  list.RSSetScissorRects(
      Rect{0, 0, static_cast<std::int32_t>(width), static_cast<std::int32_t>(height)});
  const float nothing[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(target, nothing);
  list.ClearDepthStencilView(depth_target, ClearFlags::kDepth, 0, 0);  // infinitely far away
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  frame.bind_draws(list, PassArguments(views_, DrawConstants{0, near_plane_, {width, height}}));
  record_scene(list, gpu);
  const ResourceBarrier to_read[] = {
      ResourceBarrier::Transition(visibility_, ResourceStates::kRenderTarget, kReadState),
      ResourceBarrier::Transition(depth_, ResourceStates::kDepthWrite, kReadState)};
  list.ResourceBarrier(to_read);
  list.EndEvent();
}

// Geometry with holes comes last: what stands before it hides some of its pixels, whose textures
// need not be read then.
void RasterGBuffer::record_scene(CommandList& list, const GpuScene& gpu) const {
  for (const bool with_holes : {false, true}) {
    list.SetPipelineState(with_holes ? with_holes_ : opaque_);
    for (std::uint32_t i = 0; i < draws_.size(); ++i) {
      const GpuGeometry& geometry = gpu.geometries[draws_[i].geometry];
      if (geometry.alpha_tested != with_holes) continue;
      const auto vertex_bytes = static_cast<std::uint32_t>(geometry.vertex_range().size_bytes);
      const auto index_bytes = static_cast<std::uint32_t>(geometry.index_range().size_bytes);
      list.IASetVertexBuffers(
          0, VertexBufferView{geometry.vertices, vertex_bytes, geometry.constants.vertex_stride});
      const IndexBufferView index_view = {
          geometry.indices, index_bytes,
          geometry.constants.index_size_bytes == 2 ? Format::kR16Uint : Format::kR32Uint};
      list.IASetIndexBuffer(&index_view);
      list.SetGraphicsRoot32BitConstant(kRootPassWords, i, 0);
      list.DrawIndexedInstanced(geometry.index_count, 1, 0, 0, 0);
    }
  }
}

void RasterGBuffer::record_resolve(CommandList& list, const Frame& frame) const {
  const glm::vec2 size(frame.width(), frame.height());
  resolve_.dispatch(list, frame, {}, PassArguments(views_, DrawConstants{0, near_plane_, size}),
                    frame.width(), frame.height());
}

std::uint64_t RasterGBuffer::bytes() const {
  const std::uint64_t pixels = picture_bytes(visibility_) / 8;
  return pixels * (8 + 4) + draw_buffer_.size() + geometry_buffer_.size();
}

}  // namespace kaamos::effects
