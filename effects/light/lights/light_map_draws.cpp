// SPDX-License-Identifier: MIT
#include "effects/light/lights/light_map_draws.h"

#include <shaders/light_map_draws.h>

#include <algorithm>
#include <numeric>

namespace kaamos::effects {

using namespace rtapi;

namespace {

// Numbers of light_map_draws.hlsl.
constexpr std::uint32_t kOctants = 8, kSpotFace = 8, kSunFace = 9;
constexpr std::uint32_t kDrawWord = 0, kLightWord = 1, kFaceWord = 2, kWords = 3;
constexpr ResourceStates kAtlasState = ResourceStates::kUnorderedAccess;

bool reaches(const LightConstants& light, const Bounds& box) {
  const glm::dvec3 at(light.position);
  const glm::dvec3 nearest = glm::clamp(at, box.min, box.max);
  return glm::distance(nearest, at) <= static_cast<double>(light.range);
}

}  // namespace

Result<ShaderLibrary> light_map_draws_library() {
  return LoadShaderLibrary(kaamos_shaders_light_map_draws());
}

rtapi::Status LightMapDraws::create(const Device& device, const Frame& frame, const Scene& scene,
                                    const GpuScene& gpu, const ShaderLibrary& library,
                                    const AtlasLayout& layout, const Texture& atlas,
                                    PassViews& views) {
  frame_ = &frame;
  scene_ = &scene;
  gpu_ = &gpu;
  layout_ = layout;
  atlas_ = atlas;
  boxes_ = instance_boxes(scene);
  if (const auto s = create_targets(device); !s) return s;
  if (const auto s = create_pipelines(device, library); !s) return s;
  return create_buffers(device, views);
}

rtapi::Status LightMapDraws::create_targets(const Device& device) {
  TextureDesc desc;
  desc.Width = layout_.width;
  desc.Height = layout_.height;
  desc.Format = Format::kD32Float;
  desc.Flags = ResourceFlags::kAllowDepthStencil;
  desc.InitialState = ResourceStates::kDepthWrite;
  desc.Name = "depth of the shadow atlas";
  const auto depth = device.CreateTexture(desc);
  if (!depth) return depth.error();
  depth_ = *depth;
  const auto target =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1});
  if (!target) return target.error();
  target_ = *target;
  const auto depth_target =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1});
  if (!depth_target) return depth_target.error();
  depth_target_ = *depth_target;
  const auto view = device.CreateRenderTargetView(atlas_, target_.GetCPUDescriptorHandle(0));
  if (!view) return view;
  return device.CreateDepthStencilView(depth_, depth_target_.GetCPUDescriptorHandle(0));
}

rtapi::Status LightMapDraws::create_pipelines(const Device& device, const ShaderLibrary& library) {
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = frame_->root_signature();
  desc.VS = {library, "LightMapVertex"};
  desc.InputLayout = {
      {.SemanticName = "POSITION",
       .Format = Format::kR32G32B32Float,
       .AlignedByteOffset = kPositionOffset},
      {.SemanticName = "TEXCOORD", .Format = Format::kR32G32Float, .AlignedByteOffset = kUvOffset}};
  desc.RasterizerState.CullMode = CullMode::kNone;  // rays hit both sides, too
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kGreater;
  desc.RTVFormats = {Format::kR32G32B32A32Float};
  desc.DSVFormat = Format::kD32Float;
  for (const bool has_holes : {false, true}) {
    desc.PS = {library, has_holes ? "LightMapHoles" : "LightMapPixel"};
    desc.Name = has_holes ? "light map with holes" : "light map";
    const auto created = device.CreateGraphicsPipelineState(desc);
    if (!created) return created.error();
    (has_holes ? with_holes_ : opaque_) = *created;
  }
  return {};
}

rtapi::Status LightMapDraws::create_buffers(const Device& device, PassViews& views) {
  const std::vector<SceneDraw> draws(std::max(most_scene_draws(*scene_), 1u));
  const auto draw_buffer = CreateUploadBuffer(device, draws, "light map draws");
  if (!draw_buffer) return draw_buffer.error();
  draw_buffer_ = *draw_buffer;
  std::vector<HitConstants> geometries;
  for (const GpuGeometry& geometry : gpu_->geometries) geometries.push_back(geometry.constants);
  if (geometries.empty()) geometries.emplace_back();
  const auto geometry_buffer = CreateUploadBuffer(device, geometries, "light map geometries");
  if (!geometry_buffer) return geometry_buffer.error();
  geometry_buffer_ = *geometry_buffer;
  if (const auto s = views.set_shader_resource(0, draw_buffer_, sizeof(SceneDraw)); !s) return s;
  return views.set_shader_resource(1, geometry_buffer_, sizeof(HitConstants));
}

void LightMapDraws::see(const glm::dvec3& camera_position) {
  draws_ = scene_draws(*gpu_, kMaskCasters);
  std::copy(draws_.begin(), draws_.end(), draw_buffer_.data<SceneDraw>().begin());
  lights_ = light_constants(*scene_, camera_position);
}

std::vector<std::uint32_t> LightMapDraws::draws_near(const LightConstants& light) const {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < draws_.size(); ++i) {
    const std::uint32_t instance = draws_[i].instance;
    if (instance >= boxes_.size()) continue;
    const Bounds box = draw_box(draws_[i], boxes_[instance]);
    if (!box.empty() && reaches(light, box)) out.push_back(i);
  }
  return out;
}

void LightMapDraws::record(CommandList& list, const PassViews& views) const {
  list.BeginEvent("light maps");
  list.ResourceBarrier(
      ResourceBarrier::Transition(atlas_, kAtlasState, ResourceStates::kRenderTarget));
  const CpuDescriptorHandle target = target_.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle depth = depth_target_.GetCPUDescriptorHandle(0);
  list.OMSetRenderTargets(1, &target, false, &depth);
  const float nothing[4] = {0, 0, 0, 0};
  list.ClearRenderTargetView(target, nothing);
  list.ClearDepthStencilView(depth, ClearFlags::kDepth, 0, 0);
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  const std::uint32_t words[kWords] = {};
  frame_->bind_draws(list, PassArguments(views, words));
  const auto look_at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t side) {
    const auto size = static_cast<float>(side);
    list.RSSetViewports(Viewport{static_cast<float>(x), static_cast<float>(y), size, size, 0, 1});
    list.RSSetScissorRects(Rect{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                                static_cast<std::int32_t>(x + side),
                                static_cast<std::int32_t>(y + side)});
  };
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    look_at(i % kShadowTilesPerRow * kShadowTile, i / kShadowTilesPerRow * kShadowTile,
            kShadowTile);
    const std::vector<std::uint32_t> draws = draws_near(lights_[i]);
    if (lights_[i].is_spot != 0) {
      record_face(list, i, kSpotFace, draws);
      continue;
    }
    for (std::uint32_t octant = 0; octant < kOctants; ++octant) {
      record_face(list, i, octant, draws);
    }
  }
  if (layout_.sun != 0) {
    look_at(layout_.width - layout_.sun, 0, layout_.sun);
    std::vector<std::uint32_t> all(draws_.size());
    std::iota(all.begin(), all.end(), 0u);
    record_face(list, 0, kSunFace, all);
  }
  list.ResourceBarrier(
      ResourceBarrier::Transition(atlas_, ResourceStates::kRenderTarget, kAtlasState));
  list.EndEvent();
}

void LightMapDraws::record_face(CommandList& list, std::uint32_t light, std::uint32_t face,
                                const std::vector<std::uint32_t>& draws) const {
  list.SetGraphicsRoot32BitConstant(kRootPassWords, light, kLightWord);
  list.SetGraphicsRoot32BitConstant(kRootPassWords, face, kFaceWord);
  for (const std::uint32_t i : draws) {
    const GpuGeometry& geometry = gpu_->geometries[draws_[i].geometry];
    list.SetPipelineState(geometry.alpha_tested ? with_holes_ : opaque_);
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

std::uint64_t LightMapDraws::bytes() const {
  return std::uint64_t{layout_.width} * layout_.height * 4 + draw_buffer_.size() +
         geometry_buffer_.size();
}

}  // namespace kaamos::effects
