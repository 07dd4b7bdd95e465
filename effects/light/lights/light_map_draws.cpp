// SPDX-License-Identifier: MIT
#include "effects/light/lights/light_map_draws.h"

#include <shaders/light_map_draws.h>

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
  layout_ = layout;
  atlas_ = atlas;
  boxes_ = instance_boxes(scene);
  if (const auto s = create_targets(device); !s) return s;
  const auto pipeline = ScenePipeline::create(device, frame,
                                              {.library = library,
                                               .vertex_shader = "LightMapVertex",
                                               .vertex_shader_of_holes = "LightMapHoleVertex",
                                               .pixel_shader = "LightMapPixel",
                                               .pixel_shader_of_holes = "LightMapHoles",
                                               .depth_func = ComparisonFunc::kGreater,
                                               .targets = {Format::kR32G32B32A32Float},
                                               .name = "light map"});
  if (!pipeline) return pipeline.error();
  pipeline_ = *pipeline;
  return draws_.create(device, scene, gpu, views, {}, "light map");
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

void LightMapDraws::see(const glm::dvec3& camera_position) {
  draws_.see_instances(kMaskCasters);
  lights_ = light_constants(*scene_, camera_position);
}

std::vector<std::uint32_t> LightMapDraws::draws_near(const LightConstants& light) const {
  std::vector<std::uint32_t> out;
  const std::vector<SceneDraw>& draws = draws_.draws();
  for (std::uint32_t i = 0; i < draws.size(); ++i) {
    const std::uint32_t instance = draws[i].instance;
    if (instance >= boxes_.size()) continue;
    const Bounds box = draw_box(draws[i], boxes_[instance]);
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
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    set_draw_area(list, i % kShadowTilesPerRow * kShadowTile, i / kShadowTilesPerRow * kShadowTile,
                  kShadowTile, kShadowTile);
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
    set_draw_area(list, layout_.width - layout_.sun, 0, layout_.sun, layout_.sun);
    std::vector<std::uint32_t> all(draws_.draws().size());
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
    list.SetPipelineState(pipeline_.of(draws_.geometry(i)));
    draws_.record(list, i, kDrawWord);
  }
}

std::uint64_t LightMapDraws::bytes() const {
  return std::uint64_t{layout_.width} * layout_.height * 4 + draws_.bytes();
}

}  // namespace kaamos::effects
