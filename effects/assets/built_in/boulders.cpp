// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/boulders.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/common/sampling.h"
#include "effects/assets/scene/levels.h"
#include "effects/assets/scene/shapes.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

constexpr double kRadius = 0.8;       // metres
constexpr double kNearest = 2.5;      // metres, to the first boulder
constexpr double kFarther = 1.6;      // times as far, from boulder to boulder
constexpr std::uint32_t kLumps = 12;  // of a boulder

double random(std::uint32_t seed, std::uint32_t i, std::uint32_t what) {
  return unit_float(hash_combine(hash_combine(seed, i), what));
}

// A ball with rounded dents, each about as wide as a quad of the third level.
Shape boulder(std::uint32_t seed, std::uint32_t level) {
  Shape shape = ball(kRadius, 64 >> level, 32 >> level);
  deform(shape, [&](const glm::dvec3& at) {
    const glm::dvec3 direction = glm::normalize(at);
    double depth = 0;
    for (std::uint32_t i = 0; i < kLumps; ++i) {
      const double z = 2 * random(seed, i, 0) - 1,
                   turn = 2 * glm::pi<double>() * random(seed, i, 1);
      const double r = std::sqrt(1 - z * z);
      const glm::dvec3 middle(r * std::cos(turn), z, r * std::sin(turn));
      const double apart = 1 - glm::dot(direction, middle);
      depth += 0.18 * std::exp(-apart / 0.06);
    }
    return at * (1 - depth);
  });
  return shape;
}

}  // namespace

Scene make_boulders(const BouldersDesc& desc) {
  Scene scene = start_scene("boulders");
  scene.sky = default_sky();
  scene.sun =
      Sun{.direction_to_sun = glm::normalize(glm::vec3(0.8f, 0.45f, 0.5f)), .angular_radius = 0};
  const std::uint32_t ground = add_paint(scene, "ground", {0.42f, 0.4f, 0.33f}, 0.9f);
  const std::uint32_t stone = add_paint(scene, "stone", {0.5f, 0.47f, 0.44f}, 0.8f);
  add_floor(scene, "ground", {-400, -400}, {400, 400}, 0, ground);
  const std::vector<float> coverages = default_coverages(kBoulderLevels);
  double away = kNearest;
  for (std::uint32_t i = 0; i < desc.count; ++i, away *= kFarther) {
    const std::string name = "boulder " + std::to_string(i);
    std::vector<Level> levels;
    for (std::uint32_t level = 0; level < kBoulderLevels; ++level) {
      const std::uint32_t mesh = add_mesh(scene, name + " lod" + std::to_string(level),
                                          boulder(hash_combine(desc.seed, i), level), stone);
      levels.push_back({mesh, coverages[level]});
    }
    // On both sides of the way, so that none hides the next.
    const double beside = (i % 2 == 0 ? -0.28 : 0.25) * away;
    Instance& instance =
        add_instance(scene, name, levels.front().mesh, translate({beside, 0.8 * kRadius, -away}));
    instance.levels = levels;
  }
  add_view(scene, scene.name, {0, 1.5, 0}, {0, 0.9, -4}, 0.9);
  return scene;
}

Scene boulders_at(const BouldersDesc& desc, std::uint32_t level) {
  Scene scene = make_boulders(desc);
  for (Instance& instance : scene.instances) {
    if (instance.levels.empty()) continue;
    instance.mesh = instance.levels[level].mesh;
    instance.levels.clear();
  }
  return scene;
}

}  // namespace kaamos::effects
