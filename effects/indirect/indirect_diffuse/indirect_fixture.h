// SPDX-License-Identifier: MIT
// Shared by the tests of indirect light.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/scene/light_constants.h"
#include "effects/engine/frame_fixture.h"
#include "effects/engine/picture.h"
#include "effects/engine/sums_fixture.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/indirect/indirect_diffuse/occluded_volume.h"
#include "effects/occlusion/ambient_occlusion/ambient_occlusion.h"
#include "effects/surfaces/gbuffer/gbuffer.h"

namespace kaamos::effects {

/// A scene with its G-buffer and lights, and the passes that gather light over them.
struct Stage : FrameStage {
  explicit Stage(Scene given, std::uint32_t picture_width = 24, std::uint32_t picture_height = 16,
                 const std::string& backend = "embree")
      : FrameStage(std::move(given), picture_width, picture_height, on(backend)),
        width(picture_width),
        height(picture_height) {
    const auto lights = light_constants(scene, scene.cameras.front().position());
    lighting = Lighting::create(device, frame, gpu, lighting_library().value(),
                                static_cast<std::uint32_t>(lights.size()))
                   .value();
    const RayPass gbuffer = make_pass(gbuffer_pass(gbuffer_library().value()));
    run([&](rtapi::CommandList& list) {
      gbuffer.dispatch(list, frame, {}, height);
      lighting.update(list, frame);
    });
    ids = frame.read(device, queue, kIds).value();
  }

  /// All cells get all paths.
  IndirectVolume bake(float cell, std::uint32_t samples, std::uint32_t bounces = 64) {
    BakeDesc desc;
    desc.samples = samples;
    desc.bounces = bounces;
    desc.error = 0;
    return bake(cell, desc);
  }

  IndirectVolume bake(float cell, const BakeDesc& desc, BakeStatistics* statistics = nullptr) {
    IndirectVolume volume = layout_volume(scene, cell).value();
    const rtapi::ShaderLibrary library = volume_bake_library().value();
    bake_volume({device, queue, frame, gpu, scene, lighting, library},
                scene.cameras.front().position(), desc, volume, statistics)
        .value();
    return volume;
  }

  /// Irradiance / pi; 4 channels.
  FloatImage gather(const IndirectVolume& volume, const IndirectConstants& constants,
                    std::uint32_t samples) {
    const GpuVolume gpu_volume =
        GpuVolume::create(device, volume, scene.cameras.front().position()).value();
    const rtapi::Texture picture =
        frame.create_picture(device, "indirect", rtapi::Format::kR32G32B32A32Float).value();
    PassViews views = frame.create_pass_views(device).value();
    views.set_unordered_access(0, picture).value();
    lighting.bind(views).value();
    gpu_volume.bind(views).value();
    const RayPass pass = RayPass::create(device, frame, gpu,
                                         indirect_diffuse_pass(indirect_diffuse_library().value()))
                             .value();
    rtapi::CommandList list = device.CreateCommandList().value();
    PassConstants pass_constants;
    pass_constants.sample_count = samples;
    pass.dispatch(list, frame, pass_constants, height, PassArguments(views, constants));
    queue.ExecuteAndWait(list).value();
    FloatImage image = read_picture(device, queue, picture).value();
    for (float& value : image.values) value /= static_cast<float>(samples);
    return image;
  }

  /// The volume times ambient occlusion from the depth picture; 4 channels.
  FloatImage occluded_on_screen(const IndirectVolume& volume,
                                const OccludedVolumeSettings& settings) {
    const GpuVolume gpu_volume =
        GpuVolume::create(device, volume, scene.cameras.front().position()).value();
    const rtapi::Texture picture =
        frame.create_picture(device, "indirect", rtapi::Format::kR32G32B32A32Float).value();
    PassViews views = frame.create_pass_views(device).value();
    views.set_unordered_access(0, picture).value();
    gpu_volume.bind(views).value();
    OccludedVolume passes =
        OccludedVolume::create(device, frame, occluded_volume_library().value(),
                               gtao_library().value(), occlusion_filter_library().value(), views,
                               settings)
            .value();
    rtapi::CommandList list = device.CreateCommandList().value();
    passes.record(list, frame, {}, settings);
    queue.ExecuteAndWait(list).value();
    return read_picture(device, queue, picture).value();
  }

  /// Ambient visibility, 1 channel.
  FloatImage ambient(float radius, std::uint32_t samples) {
    const RayPass pass =
        RayPass::create(device, frame, gpu,
                        ambient_occlusion_pass(ambient_occlusion_library().value()))
            .value();
    rtapi::CommandList list = device.CreateCommandList().value();
    const AmbientSums sums(device, frame);
    PassConstants pass_constants;
    pass_constants.sample_count = samples;
    pass_constants.radius = radius;
    pass_constants.accumulate = 0;
    pass.dispatch(list, frame, pass_constants, height, sums.arguments());
    queue.ExecuteAndWait(list).value();
    FloatImage image = read_picture(device, queue, sums.open).value();
    for (float& value : image.values) value /= static_cast<float>(samples);
    return image;
  }

  std::uint32_t width, height;
  Lighting lighting;
  FloatImage ids;
};

inline IndirectConstants mode(IndirectMode m, float length = 3.0f) {
  IndirectConstants constants;
  constants.mode = m;
  constants.length = length;
  return constants;
}

/// A volume around a scene with the same light in every cell.
inline IndirectVolume constant_volume(const Scene& scene, float light) {
  IndirectVolume volume = layout_volume(scene, 0.5f).value();
  for (VolumeCell& cell : volume.cells) {
    cell.mean = glm::vec3(light);
    cell.validity = 1;
  }
  return volume;
}

/// A small plane with a sphere over it. The sky should be as bright as the volume, so that places
/// outside of it get the same light.
inline Scene small_scene(float sky) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  for (Mesh& mesh : scene.meshes) {
    for (Vertex& vertex : mesh.vertices) {
      vertex.position = glm::clamp(vertex.position, glm::vec3(-6), glm::vec3(6));
    }
  }
  scene.sun.reset();
  scene.lights.clear();
  scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::vec3(sky);
  return scene;
}

/// The mean over the pixels that show a surface.
inline double mean_of(const FloatImage& image, const FloatImage& ids) {
  double sum = 0, count = 0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      if (ids.at(x, y, 0) == 0) continue;
      sum += image.at(x, y);
      ++count;
    }
  }
  return sum / count;
}

}  // namespace kaamos::effects
