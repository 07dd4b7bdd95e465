// SPDX-License-Identifier: MIT
#include "effects/reference/path_tracer.h"

#include <shaders/path_tracer.h>

#include <algorithm>
#include <string>
#include <utility>

#include "effects/assets/scene/light_constants.h"
#include "effects/northlight/settings.h"
#include "effects/reference/path_albedo.h"
#include "effects/reference/path_emitters.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kEachLamp = kPathLayerCount;  // its register u
constexpr std::uint64_t kLampBytes = 4 * sizeof(float);

RayPassDesc path_tracer_pass(rtapi::ShaderLibrary library) {
  RayPassDesc desc;
  desc.name = "path tracer";
  desc.library = std::move(library);
  desc.ray_generation = "PathTracerRayGen";
  desc.miss[kRayTypeSurface] = "PathTracerMiss";
  desc.miss[kRayTypeVisibility] = "PathShadowMiss";
  desc.hit[kRayTypeSurface] = {"PathTracerAnyHit", "PathTracerClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "PathShadowAnyHit";
  desc.payload_bytes = 112;
  return desc;
}

}  // namespace

const char* path_layer_name(PathLayer layer) {
  constexpr const char* kNames[kPathLayerCount] = {
      "radiance",   "emission", "sun",        "lamps",          "indirect",        "indirect_first",
      "reflection", "glass",    "visibility", "diffuse_albedo", "specular_albedo", "sun_tint"};
  return kNames[layer];
}

rtapi::Result<rtapi::ShaderLibrary> path_tracer_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_path_tracer());
}

rtapi::Status PathTracer::create_tables(const rtapi::Device& device, const Scene& scene,
                                        std::span<const InstanceState> states,
                                        const glm::dvec3& origin) {
  PathEmitters emitters = find_emitters(scene, states, origin);
  std::vector<float> bands = sky_bands(scene.sky);
  words_.emitters = static_cast<std::uint32_t>(emitters.triangles.size());
  words_.has_sky = bands.empty() ? 0 : 1;
  words_.has_sun = scene.sun && scene.sun->irradiance != glm::vec3(0.0f) ? 1 : 0;
  words_.has_glass = scene_offers(scene, {.glass = true}) ? 1 : 0;
  // A view needs at least one element.
  if (emitters.triangles.empty()) emitters.triangles.emplace_back();
  if (emitters.instances.empty()) emitters.instances.push_back(0);
  if (bands.empty()) bands.push_back(0.0f);
  const auto add = [&](const auto& values, const char* name) -> rtapi::Status {
    const auto buffer = rtapi::CreateUploadBuffer(device, values, name);
    if (!buffer) return buffer.error();
    const auto t = static_cast<std::uint32_t>(tables_.size());
    tables_.push_back(*buffer);
    return views_.set_shader_resource(t, *buffer, sizeof(values.front()));
  };
  if (const auto s = add(specular_albedo_table(), "specular albedo"); !s) return s;
  if (const auto s = add(emitters.triangles, "emitters"); !s) return s;
  if (const auto s = add(emitters.densities, "emitter densities"); !s) return s;
  if (const auto s = add(emitters.instances, "emitting instances"); !s) return s;
  return add(bands, "sky bands");
}

rtapi::Status PathTracer::create_layers(const rtapi::Device& device, const Frame& frame) {
  for (std::uint32_t i = 0; i < kPathLayerCount; ++i) {
    const auto picture =
        frame.create_picture(device, std::string("path ") + path_layer_name(PathLayer(i)),
                             rtapi::Format::kR32G32B32A32Float);
    if (!picture) return picture.error();
    layers_.push_back(*picture);
    if (const auto s = views_.set_unordered_access(i, *picture); !s) return s;
  }
  rtapi::BufferDesc desc;
  desc.SizeInBytes = kLampBytes * std::max<std::uint64_t>(1, static_cast<std::uint64_t>(lamps_) *
                                                                 frame.width() * frame.height());
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  desc.Name = "path lamps";
  const auto buffer = device.CreateBuffer(desc);
  if (!buffer) return buffer.error();
  each_lamp_ = *buffer;
  return views_.set_unordered_access(kEachLamp, each_lamp_, kLampBytes);
}

rtapi::Result<PathTracer> PathTracer::create(const rtapi::Device& device, const Frame& frame,
                                             const GpuScene& gpu, const Scene& scene,
                                             std::span<const InstanceState> states,
                                             const glm::dvec3& origin, const PathTracerDesc& desc,
                                             rtapi::ShaderLibrary library) {
  PathTracer out;
  out.words_.bounces = desc.bounces;
  out.words_.lamps_apart = desc.lamps_apart;
  out.words_.occlusion_radius = desc.occlusion_radius;
  out.words_.ways = desc.ways;
  out.words_.glass_tint = desc.glass_tint;
  const std::size_t lamps = light_constants(scene, origin).size();
  out.lamps_ = lamps <= desc.lamps_apart ? static_cast<std::uint32_t>(lamps) : 0;
  const auto views = frame.create_pass_views(device);
  if (!views) return views.error();
  out.views_ = *views;
  if (const auto s = out.create_tables(device, scene, states, origin); !s) return s.error();
  if (const auto s = out.create_layers(device, frame); !s) return s.error();
  const auto pass = RayPass::create(device, frame, gpu, path_tracer_pass(std::move(library)));
  if (!pass) return pass.error();
  out.pass_ = *pass;
  return out;
}

void PathTracer::record(rtapi::CommandList& list, const Frame& frame, std::uint32_t seed,
                        std::uint32_t first_sample, std::uint32_t count, std::uint32_t first_row,
                        std::uint32_t row_count) const {
  Words words = words_;
  words.seed = seed;
  PassConstants constants;
  constants.first_sample = first_sample;
  constants.sample_count = count;
  constants.first_row = first_row;
  pass_.dispatch(list, frame, constants, row_count, PassArguments(views_, words));
}

}  // namespace kaamos::effects
