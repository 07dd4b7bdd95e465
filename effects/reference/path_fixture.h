// SPDX-License-Identifier: MIT
// For tests: renders the reference of a scene, and scenes that only tests need.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "effects/assets/scene/shapes.h"
#include "effects/reference/path_reference.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {

// A reference of `samples` samples. It must not outlive `scene`.
inline std::unique_ptr<PathReference> trace_reference(const Scene& scene,
                                                      const PathReferenceDesc& desc,
                                                      std::uint32_t samples,
                                                      const std::string& backend = "embree",
                                                      std::uint32_t threads = 0) {
  rtapi::DeviceDesc device;
  device.Backend = backend;
  device.Threads = threads;
  auto reference = PathReference::create(test::device_for(device), scene, desc).value();
  EXPECT_EQ(reference->accumulate(samples, {}).value(), Outcome::kDone);
  return reference;
}

// Mean of a channel of a layer over the picture.
inline double mean_of(const PathReference& reference, const std::string& layer,
                      std::uint32_t channel = 0) {
  const FloatImage image = reference.sums().mean(*reference.sums().find(layer));
  double sum = 0;
  for (std::size_t i = channel; i < image.values.size(); i += image.channels) {
    sum += image.values[i];
  }
  return sum / (static_cast<double>(image.width) * image.height);
}

// Standard error of that mean, as the two halves tell it, at least rounding error.
inline double error_of(const PathReference& reference, const std::string& layer,
                       std::uint32_t channel = 0) {
  const PathSums& sums = reference.sums();
  const PathSums::Layer& found = *sums.find(layer);
  double difference = 0, square = 0;
  const std::size_t pixels = static_cast<std::size_t>(sums.width) * sums.height;
  for (std::size_t i = channel; i < found.sums[0].size(); i += found.channels) {
    const double half =
        0.5 * (found.sums[0][i] / sums.samples[0] - found.sums[1][i] / sums.samples[1]);
    difference += half;
    square += half * half;
  }
  return std::sqrt(square) / static_cast<double>(pixels) + 1e-6;
}

inline std::uint32_t add_material(Scene& scene, const glm::vec3& color, float metallic = 0,
                                  float roughness = 1, const glm::vec3& emissive = glm::vec3(0)) {
  Material material;
  material.name = "material " + std::to_string(scene.materials.size());
  material.constants.base_color = glm::vec4(color, 1.0f);
  material.constants.metallic = metallic;
  material.constants.roughness = roughness;
  material.constants.emissive = emissive;
  material.constants.flags = kMaterialDoubleSided;
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

inline Instance& add_thing(Scene& scene, const std::string& name, Shape shape,
                           std::uint32_t material, const glm::dvec3& at = glm::dvec3(0.0)) {
  Mesh mesh;
  mesh.name = name;
  add_shape(mesh, std::move(shape), material);
  Instance instance;
  instance.name = name;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.transform = translate(at);
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(instance);
  return scene.instances.back();
}

// An empty scene under an even sky, seen from `eye`.
inline Scene empty_scene(const glm::vec3& sky, const glm::dvec3& eye, const glm::dvec3& target,
                         double fov) {
  Scene scene;
  scene.name = "path-test";
  scene.samplers.emplace_back();
  scene.sky = {sky, sky, sky};
  Camera camera;
  camera.name = scene.name;
  camera.camera_to_world = look_at(eye, target, glm::dvec3(0.1, 1, 0.2));
  camera.vertical_fov = fov;
  scene.cameras.push_back(camera);
  return scene;
}

// A wide plane y = 0 of one material, seen at `degrees` from its normal through a field so narrow
// that the angle holds for every pixel.
inline Scene plane_scene(const glm::vec3& color, float metallic, float roughness, double degrees,
                         const glm::vec3& sky = glm::vec3(1)) {
  const double angle = degrees * 3.14159265358979 / 180;
  Scene scene = empty_scene(sky, {5 * std::sin(angle), 5 * std::cos(angle), 0}, {0, 0, 0}, 1e-3);
  const std::uint32_t material = add_material(scene, color, metallic, roughness);
  add_thing(scene, "plane", patch({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, 1, 1), material);
  return scene;
}

using test::OnBackends;

inline std::string backend_of(const testing::TestParamInfo<std::string>& info) {
  return info.param == "embree" ? "Embree" : "Vulkan";
}

}  // namespace kaamos::effects
