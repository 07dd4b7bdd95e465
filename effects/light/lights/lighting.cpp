// SPDX-License-Identifier: MIT
#include "effects/light/lights/lighting.h"

#include <shaders/lighting.h>

#include <algorithm>
#include <string>

#include "effects/assets/common/errors.h"

namespace kaamos::effects {

namespace {

rtapi::Result<rtapi::Buffer> create_words(const rtapi::Device& device, std::uint64_t count,
                                          const char* name) {
  rtapi::BufferDesc desc;
  desc.SizeInBytes = count * 4;
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  desc.Name = name;
  return device.CreateBuffer(desc);
}

// Rays write it, and draws.
rtapi::Result<rtapi::Texture> create_atlas(const rtapi::Device& device, const AtlasLayout& layout) {
  rtapi::TextureDesc desc;
  desc.Width = layout.width;
  desc.Height = layout.height;
  desc.Format = rtapi::Format::kR32G32B32A32Float;
  desc.Flags =
      rtapi::ResourceFlags::kAllowUnorderedAccess | rtapi::ResourceFlags::kAllowRenderTarget;
  desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  desc.Name = "shadow atlas";
  return device.CreateTexture(desc);
}

RayPassDesc shadow_map_pass(const rtapi::ShaderLibrary& library) {
  RayPassDesc desc;
  desc.name = "shadow maps";
  desc.library = library;
  desc.ray_generation = "ShadowAtlasRayGen";
  desc.miss[kRayTypeSurface] = "ShadowAtlasMiss";
  desc.hit[kRayTypeSurface] = {"ShadowAtlasAnyHit", "ShadowAtlasClosestHit"};
  desc.payload_bytes = 16;
  return desc;
}

RayPassDesc sun_map_pass(const rtapi::ShaderLibrary& library) {
  RayPassDesc desc = shadow_map_pass(library);
  desc.name = "map of the sun";
  desc.ray_generation = "SunMapRayGen";
  desc.hit[kRayTypeSurface].closest_hit = "SunMapClosestHit";
  return desc;
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> lighting_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_lighting());
}

rtapi::Result<Lighting> Lighting::create(const rtapi::Device& device, const Frame& frame,
                                         const GpuScene& scene, const rtapi::ShaderLibrary& library,
                                         std::uint32_t light_count) {
  if (light_count > kMaxAtlasLights) {
    return make_error(ErrorId::kLights,
                      "the scene has " + std::to_string(light_count) +
                          " local lights and the atlas of shadow maps has room for " +
                          std::to_string(kMaxAtlasLights) + "; leave some out");
  }
  Lighting out;
  out.light_count_ = light_count;
  out.layout_ = atlas_layout(light_count, frame.sun_map());
  const auto atlas = create_atlas(device, out.layout_);
  if (!atlas) return atlas.error();
  out.atlas_ = *atlas;
  const auto counts = create_words(device, kClusterCount, "cluster counts");
  if (!counts) return counts.error();
  out.counts_ = *counts;
  const auto indices =
      create_words(device, std::uint64_t{kClusterCount} * kClusterCapacity, "cluster lights");
  if (!indices) return indices.error();
  out.indices_ = *indices;
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  out.views_ = *views;
  if (const auto s = out.bind(out.views_); !s) return s.error();
  const auto clusters = ComputePass::create(device, frame, library, "BuildClusters");
  if (!clusters) return clusters.error();
  out.clusters_ = *clusters;
  if (light_count != 0) {
    const auto maps = RayPass::create(device, frame, scene, shadow_map_pass(library));
    if (!maps) return maps.error();
    out.shadow_maps_ = *maps;
  }
  if (out.layout_.sun == 0) return out;
  const auto sun = RayPass::create(device, frame, scene, sun_map_pass(library));
  if (!sun) return sun.error();
  out.sun_map_ = *sun;
  return out;
}

void Lighting::update(rtapi::CommandList& list, const Frame& frame, bool with_maps) const {
  clusters_.dispatch(list, frame, {}, PassArguments(views_), kClusterCells,
                     kClusterCount / kClusterCells);
  if (!with_maps) return;
  if (draws_) {
    draws_->record(list, views_);
    return;
  }
  if (light_count_ != 0) {
    shadow_maps_.dispatch_grid(list, frame, {}, layout_.tile_width, layout_.tile_height,
                               PassArguments(views_));
  }
  if (layout_.sun != 0) {
    sun_map_.dispatch_grid(list, frame, {}, layout_.sun, layout_.sun, PassArguments(views_));
  }
}

rtapi::Status Lighting::draw_maps(const rtapi::Device& device, const Frame& frame,
                                  const Scene& scene, const GpuScene& gpu,
                                  const rtapi::ShaderLibrary& library) {
  draws_.emplace();
  return draws_->create(device, frame, scene, gpu, library, layout_, atlas_, views_);
}

void Lighting::see(const glm::dvec3& camera_position) {
  if (draws_) draws_->see(camera_position);
}

rtapi::Status Lighting::bind(PassViews& views) const {
  if (const auto s = views.set_unordered_access(16, atlas_); !s) return s;
  if (const auto s = views.set_unordered_access(17, counts_, 4); !s) return s;
  return views.set_unordered_access(18, indices_, 4);
}

}  // namespace kaamos::effects
