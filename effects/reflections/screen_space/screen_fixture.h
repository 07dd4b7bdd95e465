// SPDX-License-Identifier: MIT
// Small frames of scenes with polished floors, for reflections that are found in the picture.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/scene/shapes.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/reflections/screen_space/hit_comparison.h"
#include "effects/reflections/traced/reflections.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {

inline constexpr std::uint32_t kScreenWidth = 64;
inline constexpr std::uint32_t kScreenHeight = 40;

// A mirror for a floor under a grey sky; what stands on it shines by itself, each thing in a colour
// of its own, so that what a pixel reflects is known.
inline Scene make_mirror_floor() {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  scene.instances.resize(1);
  scene.meshes.resize(1);
  scene.sun.reset();
  scene.lights.clear();
  scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::vec3(0.25f);
  Material& floor = scene.materials.front();
  floor.constants.base_color = glm::vec4(1);
  floor.constants.metallic = 1;
  floor.constants.roughness = 0;
  scene.cameras.front().camera_to_world = look_at(glm::dvec3(0, 1.5, 6), glm::dvec3(0, 0.8, 0));
  return scene;
}

// Adds a box of that radiance, given by half its size.
inline void add_shining_box(Scene& scene, const glm::dvec3& half, const glm::dvec3& at,
                            const glm::vec3& radiance) {
  Material material = scene.materials.front();
  material.name = "shining " + std::to_string(scene.materials.size());
  material.constants.base_color = glm::vec4(0, 0, 0, 1);
  material.constants.metallic = 0;
  material.constants.roughness = 1;
  material.constants.emissive = radiance;
  Mesh mesh;
  mesh.name = material.name;
  add_shape(mesh, box(half), static_cast<std::uint32_t>(scene.materials.size()));
  Instance instance;
  instance.name = material.name;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.transform = glm::dmat4(1.0);
  instance.transform[3] = glm::dvec4(at, 1);
  scene.materials.push_back(material);
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(instance);
}

// Adds a flat wall likewise, from a corner along two sides; it faces along their cross product.
inline void add_shining_patch(Scene& scene, const glm::dvec3& corner, const glm::dvec3& u,
                              const glm::dvec3& v, const glm::vec3& radiance) {
  add_shining_box(scene, glm::dvec3(0.1), glm::dvec3(0), radiance);
  Mesh& mesh = scene.meshes.back();
  const std::uint32_t material = mesh.geometries.front().material;
  const std::string name = mesh.name;
  mesh = {};
  mesh.name = name;
  add_shape(mesh, patch(corner, u, v, 1, 1), material);
}

// A wall, a thin rod and a box that hangs in the air over the mirror.
inline Scene make_screen_boxes() {
  Scene scene = make_mirror_floor();
  add_shining_box(scene, {1, 1, 0.2}, {0, 1, 0}, {1, 0.1f, 0.1f});
  add_shining_box(scene, {0.02, 1, 0.02}, {-1.5, 1, 1}, {0.1f, 1, 0.1f});
  add_shining_box(scene, {0.5, 0.2, 0.5}, {1.5, 2.4, 2.0}, {0.1f, 0.1f, 1});
  return scene;
}

// A renderer of a row, whose settings `change` sets, with the ray traced effect beside it for rays
// as long as those of `constants`.
inline std::unique_ptr<FrameRenderer> make_screen_renderer(
    const std::string& backend, const Scene& scene, const std::string& effect,
    const ScreenReflectionConstants& constants, const std::function<void(EffectSettings&)>& change,
    std::uint32_t width = kScreenWidth, std::uint32_t height = kScreenHeight) {
  FrameSettings settings;
  settings.width = width;
  settings.height = height;
  settings.effects = choose_effects({effect, "reflections"});
  change(settings.effects.at(effect));
  ReflectionConstants rays;
  rays.longest = constants.longest;
  rays.shortest = constants.shortest;
  rays.length_jitter = constants.length_jitter;
  settings.effects.at("reflections").set_constants(rays);
  settings.denoise.method = DenoiseMethod::kNone;
  settings.volume.given = std::make_shared<IndirectVolume>();
  rtapi::DeviceDesc device;
  device.Backend = backend;
  return FrameRenderer::create(test::device_for(device), scene, settings).value();
}

// Root mean square difference of two pictures' colours.
inline double rmse_of(const FloatImage& a, const FloatImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    if (i % a.channels == 3) continue;
    sum += std::pow(static_cast<double>(a.values[i]) - b.values[i], 2);
  }
  return std::sqrt(sum / static_cast<double>(a.values.size() / a.channels * 3));
}

inline HitComparison compare(FrameRenderer& renderer, const std::string& signal,
                             const ScreenReflectionConstants& constants) {
  return compare_hits(renderer.device(), renderer.queue(), renderer.frame(), renderer.context().gpu,
                      renderer.effects().sum(signal + "_hits"), constants, 0)
      .value();
}

}  // namespace kaamos::effects
