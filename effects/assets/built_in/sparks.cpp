// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/sparks.h"

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/common/sampling.h"

namespace kaamos::effects {

Scene make_sparks(const SparksDesc& desc) {
  Scene scene = start_scene("sparks");
  MaterialConstants mirror;
  mirror.base_color = glm::vec4(0.9f, 0.9f, 0.9f, 1.0f);
  mirror.metallic = 1;
  mirror.roughness = 0;
  const std::uint32_t floor = add_material(scene, "mirror", mirror);
  MaterialConstants dark;
  dark.base_color = glm::vec4(0, 0, 0, 1);
  dark.emissive = glm::vec3(0.02f, 0.03f, 0.12f);
  dark.specular = 0;
  const std::uint32_t wall = add_material(scene, "wall", dark);
  add_floor(scene, "floor", {-4, -4}, {4, 4}, 0, floor);
  add_box(scene, "wall", {-4, 0, -4.2}, {4, 3, -4}, wall);
  const auto random = [&](std::uint32_t i, std::uint32_t what) {
    return unit_float(hash_combine(hash_combine(desc.seed, i), what));
  };
  for (std::uint32_t i = 0; i < desc.sparks + desc.puffs; ++i) {
    Particle& particle = scene.particles.emplace_back();
    particle.position =
        glm::dvec3(-2 + 4 * random(i, 0), 0.3 + 1.8 * random(i, 1), -3.9 + random(i, 2));
    const bool is_spark = i < desc.sparks;
    particle.radius = is_spark ? 0.04f : 0.3f;
    particle.radiance = is_spark ? glm::vec3(6.0f, 1.5f, 0.1f) : glm::vec3(0.05f);
    particle.opacity = is_spark ? 0.0f : 0.5f;
  }
  add_view(scene, scene.name, {0, 1.2, 3}, {0, 0.7, -2}, 0.8);
  return scene;
}

}  // namespace kaamos::effects
