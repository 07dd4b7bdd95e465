// SPDX-License-Identifier: MIT
#include "effects/reflections/environment_map/environment_map.h"

#include <fmt/format.h>
#include <shaders/environment_bake.h>

#include <any>
#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/ray_pass.h"
#include "effects/reflections/environment_map/probe_places.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kTexels = 20;  // register u, space3
constexpr std::uint32_t kCubes = 5;    // register t, space3
constexpr std::uint32_t kProbes = 6;
constexpr std::uint32_t kFaces = 6;
constexpr std::size_t kMostProbes = 64;

// Mirrors EnvironmentProbe in environment_map.hlsli.
struct ProbeConstants {
  glm::vec3 position;
  float padding0 = 0;
  glm::vec3 box_min;
  float padding1 = 0;
  glm::vec3 box_max;
  float padding2 = 0;
};

// Mirrors BakeConstants in environment_bake.hlsl.
struct BakeConstants {
  glm::vec3 probe;
  std::uint32_t first_face;
  std::uint32_t side;
  std::uint32_t samples;
  float roughness;
};

RayPassDesc bake_pass(const rtapi::ShaderLibrary& library) {
  RayPassDesc desc;
  desc.name = "environment maps";
  desc.library = library;
  desc.ray_generation = "EnvironmentRayGen";
  desc.miss[kRayTypeSurface] = "EnvironmentMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"EnvironmentAnyHit", "EnvironmentClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 12;
  desc.max_recursion_depth = 2;
  return desc;
}

bool is_finite(const glm::dvec3& v) {
  return !glm::any(glm::isnan(v)) && !glm::any(glm::isinf(v));
}

rtapi::Result<rtapi::Texture> create_cubes(const rtapi::Device& device, const EnvironmentDesc& desc,
                                           std::uint32_t levels, const char* name) {
  rtapi::TextureDesc texture;
  texture.Width = texture.Height = desc.side;
  texture.DepthOrArraySize = static_cast<std::uint16_t>(kFaces * desc.probes.size());
  texture.MipLevels = static_cast<std::uint16_t>(levels);
  texture.Format = rtapi::Format::kR16G16B16A16Float;
  texture.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  texture.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  texture.Name = name;
  return device.CreateTexture(texture);
}

rtapi::Status bind_cubes(PassViews& views, const rtapi::Texture& cubes) {
  rtapi::ShaderResourceViewDesc view;
  view.ViewDimension = rtapi::SrvDimension::kTextureCubeArray;
  return views.set_shader_resource(kCubes, cubes, view);
}

rtapi::Status bind_level(PassViews& views, const rtapi::Texture& cubes, std::uint32_t level) {
  rtapi::UnorderedAccessViewDesc view;
  view.ViewDimension = rtapi::UavDimension::kTexture2DArray;
  view.Texture2DArray.MipSlice = level;
  return views.set_unordered_access(kTexels, cubes, view);
}

rtapi::Status execute(const EffectScope& scope,
                      const std::function<void(rtapi::CommandList&)>& record) {
  auto list = scope.device.CreateCommandList();
  if (!list) return list.error();
  record(*list);
  return scope.queue.ExecuteAndWait(*list);
}

rtapi::ResourceBarrier to_read(const rtapi::Texture& cubes) {
  // Pixel shaders read them as well. [effects/glass/drawn_glass]
  return rtapi::ResourceBarrier::Transition(cubes, rtapi::ResourceStates::kUnorderedAccess,
                                            rtapi::ResourceStates::kAllShaderResource);
}

// Renders the finest level of all cubes.
rtapi::Status render(const EffectScope& scope, const EnvironmentDesc& desc,
                     const rtapi::ShaderLibrary& library, const rtapi::Texture& finest,
                     const glm::dvec3& camera) {
  if (const auto s = bind_level(scope.views, finest, 0); !s) return s;
  const auto pass = RayPass::create(scope.device, scope.frame, scope.gpu, bake_pass(library));
  if (!pass) return pass.error();
  return execute(scope, [&](rtapi::CommandList& list) {
    for (std::uint32_t i = 0; i < desc.probes.size(); ++i) {
      const BakeConstants constants = {glm::vec3(desc.probes[i].position - camera), kFaces * i,
                                       desc.side, desc.rays, 0.0f};
      pass->dispatch_grid(list, scope.frame, {}, kFaces * desc.side, desc.side,
                          PassArguments(scope.views, constants));
    }
    list.ResourceBarrier(to_read(finest));
  });
}

// Fills level `level` of the cubes from the finest.
rtapi::Status filter(const EffectScope& scope, const EnvironmentDesc& desc, const ComputePass& pass,
                     const rtapi::Texture& cubes, std::uint32_t level) {
  if (const auto s = bind_level(scope.views, cubes, level); !s) return s;
  const std::uint32_t side = desc.side >> level;
  return execute(scope, [&](rtapi::CommandList& list) {
    for (std::uint32_t i = 0; i < desc.probes.size(); ++i) {
      const BakeConstants constants = {glm::vec3(0.0f), kFaces * i, side,
                                       level == 0 ? 0 : desc.directions,
                                       static_cast<float>(level) / (kEnvironmentLevels - 1)};
      pass.dispatch(list, scope.frame, {}, PassArguments(scope.views, constants), kFaces * side,
                    side);
    }
  });
}

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> environment_bake_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_environment_bake());
}

rtapi::Status check_environment(const EnvironmentDesc& desc) {
  const auto fail = [](const std::string& text) {
    return make_error(ErrorId::kEnvironmentMap, text);
  };
  if (desc.probes.empty() || desc.probes.size() > kMostProbes) {
    return fail("there are " + std::to_string(desc.probes.size()) +
                " probes, and 1 to 64 are allowed");
  }
  const bool is_power = desc.side != 0 && (desc.side & (desc.side - 1)) == 0;
  if (!is_power || desc.side < 16 || desc.side > 1024) {
    return fail("a face has " + std::to_string(desc.side) +
                " texels a side; choose a power of two from 16 to 1024");
  }
  if (desc.rays == 0 || desc.directions == 0) {
    return fail("EnvironmentDesc::rays and directions are at least 1");
  }
  for (std::size_t i = 0; i < desc.probes.size(); ++i) {
    const EnvironmentProbe& probe = desc.probes[i];
    if (is_finite(probe.position) && is_finite(probe.box_min) && is_finite(probe.box_max) &&
        glm::all(glm::lessThan(probe.box_min, probe.box_max))) {
      continue;
    }
    return fail("probe " + std::to_string(i) +
                " has a position or a box that is not finite, or a box whose lower corner is not "
                "below its upper one");
  }
  return {};
}

rtapi::Result<EnvironmentMap> EnvironmentMap::create(const EffectScope& scope,
                                                     const EnvironmentDesc& desc) {
  if (const auto s = check_environment(desc); !s) return s.error();
  EnvironmentMap out;
  out.desc_ = desc;
  // The top level is relative to it.
  const glm::dvec3 camera = scope.scene.cameras.front().position();
  const rtapi::ShaderLibrary& library =
      scope.library("reflections/environment_map/environment_bake");
  const auto finest = create_cubes(scope.device, desc, 1, "environment, finest");
  if (!finest) return finest.error();
  const auto cubes = create_cubes(scope.device, desc, kEnvironmentLevels, "environment");
  if (!cubes) return cubes.error();
  out.cubes_ = *cubes;
  if (const auto s = render(scope, desc, library, *finest, camera); !s) return s.error();
  if (const auto s = bind_cubes(scope.views, *finest); !s) return s.error();
  const auto pass = ComputePass::create(scope.device, scope.frame, library, "FilterEnvironment");
  if (!pass) return pass.error();
  for (std::uint32_t level = 0; level < kEnvironmentLevels; ++level) {
    if (const auto s = filter(scope, desc, *pass, out.cubes_, level); !s) return s.error();
  }
  const auto read =
      execute(scope, [&](rtapi::CommandList& list) { list.ResourceBarrier(to_read(out.cubes_)); });
  if (!read) return read.error();
  if (const auto s = out.bind(scope.views); !s) return s.error();
  if (const auto s = out.set_origin(scope.device, camera, scope.views); !s) return s.error();
  return out;
}

rtapi::Result<EnvironmentMap> EnvironmentMap::of_scene(const EffectScope& scope,
                                                       const EnvironmentConstants& constants) {
  const auto& [side, rays, directions, most_probes] = constants;
  std::any& kept =
      scope
          .shared[fmt::format("environment map: {} {} {} {}", side, rays, directions, most_probes)];
  if (!kept.has_value()) {
    auto probes = environment_probes(scope, most_probes);
    if (!probes) return probes.error();
    auto map = create(scope, {std::move(*probes), side, rays, directions});
    if (!map) return map.error();
    kept = std::move(*map);
  }
  auto out = std::any_cast<EnvironmentMap>(kept);
  if (const auto s = out.bind(scope.views); !s) return s.error();
  const glm::dvec3 camera = scope.scene.cameras.front().position();
  if (const auto s = out.set_origin(scope.device, camera, scope.views); !s) return s.error();
  return out;
}

rtapi::Status EnvironmentMap::set_origin(const rtapi::Device& device, const glm::dvec3& camera,
                                         PassViews& views) {
  std::vector<ProbeConstants> constants;
  for (const EnvironmentProbe& probe : desc_.probes) {
    ProbeConstants each = {};
    each.position = glm::vec3(probe.position - camera);
    each.box_min = glm::vec3(probe.box_min - camera);
    each.box_max = glm::vec3(probe.box_max - camera);
    constants.push_back(each);
  }
  const auto buffer = rtapi::CreateUploadBuffer(device, constants, "environment probes");
  if (!buffer) return buffer.error();
  probes_ = *buffer;
  return views.set_shader_resource(kProbes, probes_, sizeof(ProbeConstants));
}

rtapi::Status EnvironmentMap::bind(PassViews& views) const {
  return bind_cubes(views, cubes_);
}

std::uint64_t EnvironmentMap::bytes() const {
  std::uint64_t texels = 0;
  for (std::uint32_t level = 0; level < kEnvironmentLevels; ++level) {
    texels += std::uint64_t{desc_.side >> level} * (desc_.side >> level);
  }
  return texels * kFaces * desc_.probes.size() * 8;
}

rtapi::Result<EnvironmentFallback> EnvironmentFallback::create(const EffectScope& scope,
                                                               bool is_wanted) {
  EnvironmentFallback out;
  if (!is_wanted) return out;
  auto map = EnvironmentMap::of_scene(scope);
  if (!map) return map.error();
  out.device_ = &scope.device;
  out.views_ = &scope.views;
  out.map_ = std::move(*map);
  return out;
}

rtapi::Status EnvironmentFallback::begin_frame(const Camera& camera) {
  return map_ ? map_->set_origin(*device_, camera.position(), *views_) : rtapi::Status{};
}

}  // namespace kaamos::effects
