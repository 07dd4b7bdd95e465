// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/portrait.h"

#include <cmath>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"

namespace kaamos::effects {

namespace {

std::uint32_t add_variant(Scene& scene, const char* name, const glm::vec3& color, float roughness,
                          std::uint32_t flag) {
  MaterialConstants constants;
  constants.base_color = glm::vec4(color, 1);
  constants.roughness = roughness;
  constants.flags = flag;
  return add_material(scene, name, constants);
}

// So fine that the painting's edges are sharp.
Mesh eye_ball(std::uint32_t material) {
  Shape shape = ball(1, 512, 256);
  std::vector<VertexColor> colors;
  for (const Vertex& vertex : shape.vertices) {
    const glm::vec3 p = vertex.position;
    const double away = p.z > 0 ? std::hypot(p.x, p.y) : 1;
    colors.emplace_back(glm::round(glm::vec4(eye_color(away), 1) * 65535.0f));
  }
  Mesh mesh;
  mesh.name = "eye";
  add_shape(mesh, std::move(shape), material);
  mesh.add_colors(colors);
  return mesh;
}

}  // namespace

glm::vec3 eye_color(double away) {
  if (away < 0.18) return glm::vec3(0);
  return away < 0.45 ? glm::vec3(0.12f, 0.3f, 0.35f) : glm::vec3(0.8f, 0.78f, 0.75f);
}

Scene make_portrait() {
  Scene scene = start_scene("portrait");
  // Dim: by the light of the sky all things look as the unified model has them.
  scene.sky = {.zenith = glm::vec3(0.1f), .horizon = glm::vec3(0.12f), .ground = glm::vec3(0.05f)};
  scene.sun = Sun{.direction_to_sun = glm::normalize(glm::vec3(0.75f, 0.22f, 0.55f))};
  MaterialConstants silver;
  silver.base_color = glm::vec4(0.9f, 0.9f, 0.9f, 1);
  silver.metallic = 1;
  silver.roughness = 0;
  const std::uint32_t ground = add_paint(scene, "ground", glm::vec3(0.3f), 0.9f);
  const std::uint32_t mirror = add_material(scene, "mirror", silver);
  const std::uint32_t skin = add_variant(scene, "skin", {0.8f, 0.5f, 0.4f}, 0.45f, kMaterialSkin);
  const std::uint32_t eye = add_variant(scene, "eye", glm::vec3(1), 0.12f, kMaterialEye);
  const std::uint32_t hair = add_variant(scene, "hair", {0.55f, 0.3f, 0.12f}, 0.55f, kMaterialHair);
  add_floor(scene, "floor", {-6, -6}, {6, 6}, 0, ground);
  add_box(scene, "mirror", {-2.6, 0, -1.6}, {2.6, 1.9, -1.5}, mirror);
  add_thing(scene, "skin", ball(0.5, 128, 64), skin, translate({-1.3, 0.5, 0}));
  scene.meshes.push_back(eye_ball(eye));
  add_instance(scene, "eye", static_cast<std::uint32_t>(scene.meshes.size() - 1),
               translate({0, 0.5, 0}) * rotate_y(0.5) * glm::dmat4(glm::dmat3(0.5)));
  add_thing(scene, "hair", post(0.35, 1, 128), hair, translate({1.3, 0, 0}));
  add_view(scene, scene.name, {0, 1.2, 3.6}, {0, 0.6, 0}, 0.75);
  return scene;
}

}  // namespace kaamos::effects
