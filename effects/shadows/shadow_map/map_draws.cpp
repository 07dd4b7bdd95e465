// SPDX-License-Identifier: MIT
#include "effects/shadows/shadow_map/map_draws.h"

#include <algorithm>
#include <cstddef>

#include "effects/shadows/shadow_map/shadow_map.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr ResourceStates kMapState = ResourceStates::kNonPixelShaderResource;
constexpr std::uint32_t kDrawWord = offsetof(ShadowMapConstants, draw) / 4;
constexpr std::uint32_t kMapWord = offsetof(ShadowMapConstants, map) / 4;

}  // namespace

rtapi::Status ShadowMapDraws::create(const EffectScope& scope, const ShaderLibrary& library,
                                     std::uint32_t size, std::uint32_t count) {
  frame_ = &scope.frame;
  gpu_ = &scope.gpu;
  views_ = &scope.views;
  size_ = size;
  count_ = count;
  boxes_ = instance_boxes(scope.scene);
  if (const auto s = create_targets(scope.device); !s) return s;
  if (const auto s = create_pipelines(scope.device, library); !s) return s;
  return create_buffers(scope.device, scope.scene);
}

rtapi::Status ShadowMapDraws::create_targets(const Device& device) {
  TextureDesc desc;
  desc.Width = size_;
  desc.Height = size_;
  desc.DepthOrArraySize = static_cast<std::uint16_t>(count_);
  desc.Format = Format::kR32Typeless;  // drawn as D32_FLOAT, read as R32_FLOAT
  desc.Flags = ResourceFlags::kAllowDepthStencil;
  desc.InitialState = kMapState;
  desc.Name = "shadow maps";
  const auto maps = device.CreateTexture(desc);
  if (!maps) return maps.error();
  maps_ = *maps;
  const auto targets =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = count_});
  if (!targets) return targets.error();
  targets_ = *targets;
  for (std::uint32_t i = 0; i < count_; ++i) {
    DepthStencilViewDesc view;
    view.Format = Format::kD32Float;
    view.ViewDimension = DsvDimension::kTexture2DArray;
    view.Texture2DArray = {.FirstArraySlice = i, .ArraySize = 1};
    const auto s = device.CreateDepthStencilView(maps_, view, targets_.GetCPUDescriptorHandle(i));
    if (!s) return s;
  }
  ShaderResourceViewDesc view;
  view.Format = Format::kR32Float;
  view.ViewDimension = SrvDimension::kTexture2DArray;
  return views_->set_shader_resource(4, maps_, view);
}

rtapi::Status ShadowMapDraws::create_pipelines(const Device& device, const ShaderLibrary& library) {
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = frame_->root_signature();
  desc.VS = {library, "ShadowMapVertex"};
  desc.InputLayout = {
      {.SemanticName = "POSITION",
       .Format = Format::kR32G32B32Float,
       .AlignedByteOffset = kPositionOffset},
      {.SemanticName = "TEXCOORD", .Format = Format::kR32G32Float, .AlignedByteOffset = kUvOffset}};
  desc.RasterizerState.CullMode = CullMode::kNone;  // rays hit both sides, too
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kLess;
  desc.DSVFormat = Format::kD32Float;
  desc.Name = "shadow map";
  const auto opaque = device.CreateGraphicsPipelineState(desc);
  if (!opaque) return opaque.error();
  opaque_ = *opaque;
  desc.PS = {library, "ShadowMapHoles"};
  desc.Name = "shadow map with holes";
  const auto with_holes = device.CreateGraphicsPipelineState(desc);
  if (!with_holes) return with_holes.error();
  with_holes_ = *with_holes;
  return {};
}

rtapi::Status ShadowMapDraws::create_buffers(const Device& device, const Scene& scene) {
  const std::vector<SceneDraw> draws(std::max(most_scene_draws(scene), 1u));
  const auto draw_buffer = CreateUploadBuffer(device, draws, "shadow map draws");
  if (!draw_buffer) return draw_buffer.error();
  draw_buffer_ = *draw_buffer;
  std::vector<HitConstants> geometries;
  for (const GpuGeometry& geometry : gpu_->geometries) geometries.push_back(geometry.constants);
  if (geometries.empty()) geometries.emplace_back();
  const auto geometry_buffer = CreateUploadBuffer(device, geometries, "shadow map geometries");
  if (!geometry_buffer) return geometry_buffer.error();
  geometry_buffer_ = *geometry_buffer;
  const auto map_buffer =
      CreateUploadBuffer(device, std::vector<SunMap>(count_), "places of shadow maps");
  if (!map_buffer) return map_buffer.error();
  map_buffer_ = *map_buffer;
  if (const auto s = views_->set_shader_resource(0, draw_buffer_, sizeof(SceneDraw)); !s) return s;
  const auto s = views_->set_shader_resource(1, geometry_buffer_, sizeof(HitConstants));
  if (!s) return s;
  return views_->set_shader_resource(2, map_buffer_, sizeof(SunMap));
}

void ShadowMapDraws::see_instances(const glm::dvec3& camera_position) {
  camera_position_ = camera_position;
  draws_ = scene_draws(*gpu_, kMaskCasters);
  std::copy(draws_.begin(), draws_.end(), draw_buffer_.data<SceneDraw>().begin());
  bounds_ = Bounds();
  std::size_t last = boxes_.size();
  for (const SceneDraw& draw : draws_) {
    if (draw.instance == last || draw.instance >= boxes_.size()) continue;
    last = draw.instance;
    const Bounds box = draw_box(draw, boxes_[last]);
    if (box.empty()) continue;
    bounds_.add(camera_position + box.min);
    bounds_.add(camera_position + box.max);
  }
}

Bounds ShadowMapDraws::bounds_of(std::uint32_t instance) const {
  Bounds out;
  if (instance >= boxes_.size()) return out;
  for (const SceneDraw& draw : draws_) {
    if (draw.instance != instance) continue;
    const Bounds box = draw_box(draw, boxes_[instance]);
    if (box.empty()) continue;
    out.add(camera_position_ + box.min);
    out.add(camera_position_ + box.max);
  }
  return out;
}

void ShadowMapDraws::set_maps(const std::vector<SunMap>& maps) {
  std::copy_n(maps.begin(), std::min<std::size_t>(maps.size(), count_),
              map_buffer_.data<SunMap>().begin());
}

void ShadowMapDraws::record(CommandList& list, const ShadowMapConstants& constants) const {
  list.BeginEvent("shadow maps");
  list.ResourceBarrier(ResourceBarrier::Transition(maps_, kMapState, ResourceStates::kDepthWrite));
  const auto side = static_cast<float>(size_);
  list.RSSetViewports(Viewport{0, 0, side, side, 0, 1});
  list.RSSetScissorRects(
      Rect{0, 0, static_cast<std::int32_t>(size_), static_cast<std::int32_t>(size_)});
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  frame_->bind_draws(list, PassArguments(*views_, constants));
  for (std::uint32_t i = 0; i < count_; ++i) {
    const CpuDescriptorHandle target = targets_.GetCPUDescriptorHandle(i);
    list.OMSetRenderTargets(0, nullptr, false, &target);
    list.ClearDepthStencilView(target, ClearFlags::kDepth, 1, 0);
    list.SetGraphicsRoot32BitConstant(kRootPassWords, i, kMapWord);
    record_scene(list, false);
    record_scene(list, true);
  }
  list.ResourceBarrier(ResourceBarrier::Transition(maps_, ResourceStates::kDepthWrite, kMapState));
  list.EndEvent();
}

void ShadowMapDraws::record_scene(CommandList& list, bool with_holes) const {
  list.SetPipelineState(with_holes ? with_holes_ : opaque_);
  for (std::uint32_t i = 0; i < draws_.size(); ++i) {
    const GpuGeometry& geometry = gpu_->geometries[draws_[i].geometry];
    if (geometry.alpha_tested != with_holes) continue;
    const auto vertex_bytes = static_cast<std::uint32_t>(geometry.vertex_range().size_bytes);
    const auto index_bytes = static_cast<std::uint32_t>(geometry.index_range().size_bytes);
    list.IASetVertexBuffers(
        0, VertexBufferView{geometry.vertices, vertex_bytes, geometry.constants.vertex_stride});
    const IndexBufferView index_view = {
        geometry.indices, index_bytes,
        geometry.constants.index_size_bytes == 2 ? Format::kR16Uint : Format::kR32Uint};
    list.IASetIndexBuffer(&index_view);
    list.SetGraphicsRoot32BitConstant(kRootPassWords, i, kDrawWord);
    list.DrawIndexedInstanced(geometry.index_count, 1, 0, 0, 0);
  }
}

std::uint64_t ShadowMapDraws::bytes() const {
  return std::uint64_t{size_} * size_ * count_ * 4 + draw_buffer_.size() + geometry_buffer_.size() +
         map_buffer_.size();
}

}  // namespace kaamos::effects
