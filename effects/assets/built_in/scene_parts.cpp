// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/scene_parts.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

namespace kaamos::effects {

Scene start_scene(std::string name) {
  Scene scene;
  scene.name = std::move(name);
  scene.samplers.push_back(Sampler{});
  return scene;
}

std::uint32_t add_material(Scene& scene, std::string name, const MaterialConstants& constants) {
  Material material;
  material.name = std::move(name);
  material.constants = constants;
  scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t add_paint(Scene& scene, std::string name, const glm::vec3& color, float roughness) {
  MaterialConstants constants;
  constants.base_color = glm::vec4(color, 1.0f);
  constants.roughness = roughness;
  return add_material(scene, std::move(name), constants);
}

std::uint32_t add_mesh(Scene& scene, std::string name, Shape shape, std::uint32_t material,
                       bool alpha_tested) {
  Mesh mesh;
  mesh.name = std::move(name);
  add_shape(mesh, std::move(shape), material, alpha_tested);
  scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

Instance& add_instance(Scene& scene, std::string name, std::uint32_t mesh,
                       const glm::dmat4& transform) {
  Instance instance;
  instance.name = std::move(name);
  instance.mesh = mesh;
  instance.transform = transform;
  scene.instances.push_back(std::move(instance));
  return scene.instances.back();
}

Instance& add_thing(Scene& scene, std::string name, Shape shape, std::uint32_t material,
                    const glm::dmat4& transform) {
  const std::uint32_t mesh = add_mesh(scene, name, std::move(shape), material);
  return add_instance(scene, std::move(name), mesh, transform);
}

Instance& add_box(Scene& scene, std::string name, const glm::dvec3& low, const glm::dvec3& high,
                  std::uint32_t material) {
  return add_thing(scene, std::move(name), box((high - low) * 0.5), material,
                   translate((low + high) * 0.5));
}

Instance& add_floor(Scene& scene, std::string name, const glm::dvec2& low, const glm::dvec2& high,
                    double y, std::uint32_t material) {
  const glm::dvec2 size = high - low;
  return add_thing(scene, std::move(name),
                   patch({low.x, y, high.y}, {size.x, 0, 0}, {0, 0, -size.y}, 1, 1), material);
}

Light& add_lamp(Scene& scene, std::string name, const glm::dvec3& position, float intensity,
                float radius, float range) {
  Light light;
  light.name = std::move(name);
  light.position = position;
  light.intensity = intensity;
  light.radius = radius;
  light.range = range;
  scene.lights.push_back(std::move(light));
  return scene.lights.back();
}

void add_view(Scene& scene, std::string name, const glm::dvec3& eye, const glm::dvec3& target,
              double fov) {
  Camera camera;
  camera.name = std::move(name);
  camera.camera_to_world = look_at(eye, target);
  camera.vertical_fov = fov;
  scene.cameras.push_back(std::move(camera));
}

Shape ball(double radius, int segments, int rings) {
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= rings; ++i) {
    const double angle = glm::pi<double>() * (static_cast<double>(i) / rings - 0.5);
    profile.emplace_back(i == 0 || i == rings ? 0.0 : radius * std::cos(angle),
                         radius * std::sin(angle));
  }
  return revolve(profile, segments);
}

Shape post(double radius, double height, int sides) {
  const glm::dvec2 profile[] = {{0.0, 0.0}, {radius, 0.0}, {radius, height}, {0.0, height}};
  return revolve(profile, sides);
}

}  // namespace kaamos::effects
