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
  const auto pipeline = ScenePipeline::create(scope.device, scope.frame,
                                              {.library = library,
                                               .vertex_shader = "ShadowMapVertex",
                                               .vertex_shader_of_holes = "ShadowMapHoleVertex",
                                               .pixel_shader_of_holes = "ShadowMapHoles",
                                               .depth_func = ComparisonFunc::kLess,
                                               .name = "shadow map"});
  if (!pipeline) return pipeline.error();
  pipeline_ = *pipeline;
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

rtapi::Status ShadowMapDraws::create_buffers(const Device& device, const Scene& scene) {
  if (const auto s = draws_.create(device, scene, *gpu_, *views_, {}, "shadow map"); !s) return s;
  const auto map_buffer =
      CreateUploadBuffer(device, std::vector<SunMap>(count_), "places of shadow maps");
  if (!map_buffer) return map_buffer.error();
  map_buffer_ = *map_buffer;
  return views_->set_shader_resource(2, map_buffer_, sizeof(SunMap));
}

void ShadowMapDraws::see_instances(const glm::dvec3& camera_position) {
  camera_position_ = camera_position;
  draws_.see_instances(kMaskCasters);
  bounds_ = Bounds();
  std::size_t last = boxes_.size();
  for (const SceneDraw& draw : draws_.draws()) {
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
  for (const SceneDraw& draw : draws_.draws()) {
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
  set_draw_area(list, 0, 0, size_, size_);
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  frame_->bind_draws(list, PassArguments(*views_, constants));
  for (std::uint32_t i = 0; i < count_; ++i) {
    const CpuDescriptorHandle target = targets_.GetCPUDescriptorHandle(i);
    list.OMSetRenderTargets(0, nullptr, false, &target);
    list.ClearDepthStencilView(target, ClearFlags::kDepth, 1, 0);
    list.SetGraphicsRoot32BitConstant(kRootPassWords, i, kMapWord);
    pipeline_.record(list, draws_, kDrawWord);
  }
  list.ResourceBarrier(ResourceBarrier::Transition(maps_, ResourceStates::kDepthWrite, kMapState));
  list.EndEvent();
}

std::uint64_t ShadowMapDraws::bytes() const {
  return std::uint64_t{size_} * size_ * count_ * 4 + draws_.bytes() + map_buffer_.size();
}

}  // namespace kaamos::effects
