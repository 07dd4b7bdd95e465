// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/light_forest.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/common/sampling.h"

namespace kaamos::effects {
namespace {

constexpr double kTwoPi = 2.0 * glm::pi<double>();
constexpr const char* kName = "light-forest";
constexpr std::uint32_t kPosts = 120;

double random(std::uint32_t seed, std::uint32_t which, std::uint32_t use) {
  return unit_float(hash_combine(seed, which * 16u + use));
}

// Light `i` of the forest at a moment. Each flies about a place of its own.
Light light_at(std::uint32_t seed, std::uint32_t count, std::uint32_t i, double seconds) {
  Light light;
  light.name = "light " + std::to_string(i);
  const double range = 0.5 * std::pow(20.0, std::pow(random(seed, i, 0), 3.0));
  const double turn = kTwoPi * (random(seed, i, 1) + 0.1 * seconds / (0.3 + random(seed, i, 2)));
  const double reach = 0.25 * range;
  light.position = {kForestHalf * (2.0 * random(seed, i, 3) - 1.0) + reach * std::cos(turn),
                    0.2 + 0.35 * range * random(seed, i, 4) + 0.1 * std::sin(2.0 * turn),
                    kForestHalf * (2.0 * random(seed, i, 5) - 1.0) + reach * std::sin(turn)};
  const double hue = random(seed, i, 6);
  for (int c = 0; c < 3; ++c) {
    light.color[c] = static_cast<float>(0.55 + 0.45 * std::cos(kTwoPi * (hue - c / 3.0)));
  }
  light.range = static_cast<float>(range);
  light.radius = static_cast<float>(0.02 * range);
  // The more there are, the less each gives.
  const double share = std::min(1.0, 100.0 / count);
  light.intensity = static_cast<float>(1.2 * range * range * std::max(share, 0.05));
  if (i % 4 == 1) {
    light.intensity *= static_cast<float>(
        0.55 + 0.45 * std::sin(kTwoPi * (kForestFlicker * seconds + random(seed, i, 7))));
  }
  light.baked = false;
  if (i % 3 == 2) {
    light.type = LightType::kSpot;
    light.position.y += 0.3 * range;
    light.direction = glm::vec3(
        glm::normalize(glm::dvec3(0.5 * std::cos(0.7 * turn), -1.0, 0.5 * std::sin(0.7 * turn))));
    light.outer_cone_angle = static_cast<float>(0.3 + 0.6 * random(seed, i, 8));
    light.inner_cone_angle = 0.7f * light.outer_cone_angle;
  }
  return light;
}

}  // namespace

Scene make_light_forest(const LightForestDesc& desc) {
  Scene scene = start_scene(kName);
  scene.sky = {.zenith = glm::vec3(0.002f, 0.003f, 0.006f),
               .horizon = glm::vec3(0.004f),
               .ground = glm::vec3(0.001f)};
  scene.exposure = 1.5f;
  const std::uint32_t field = add_paint(scene, "field", {0.5f, 0.5f, 0.48f}, 0.7f);
  const std::uint32_t bark = add_paint(scene, "bark", {0.42f, 0.34f, 0.27f}, 0.8f);
  add_floor(scene, "field", {-2 * kForestHalf, -2 * kForestHalf},
            {2 * kForestHalf, 2 * kForestHalf}, 0.0, field);
  const std::uint32_t trunk = add_mesh(scene, "post", post(0.12, 2.6, 16), bark);
  const std::uint32_t stone = add_mesh(scene, "stone", ball(0.3, 16, 8), field);
  for (std::uint32_t i = 0; i < kPosts; ++i) {
    const double x = kForestHalf * (2.0 * random(desc.seed ^ 0x5a5au, i, 0) - 1.0);
    const double z = kForestHalf * (2.0 * random(desc.seed ^ 0x5a5au, i, 1) - 1.0);
    if (i % 3 == 0) {
      add_instance(scene, "stone " + std::to_string(i), stone, translate({x, 0.1, z}));
    } else {
      add_instance(scene, "post " + std::to_string(i), trunk, translate({x, 0.0, z}));
    }
  }
  const std::uint32_t count = std::clamp(desc.lights, 1u, 10000u);
  for (std::uint32_t i = 0; i < count; ++i) {
    scene.lights.push_back(light_at(desc.seed, count, i, 0.0));
  }
  add_view(scene, "forest", {0, 4.2, kForestHalf + 3.0}, {0, 0.2, 2.0}, 0.9);
  return scene;
}

void move_lights(Scene& scene, double seconds, std::uint32_t seed) {
  if (scene.name != kName) return;
  const auto count = static_cast<std::uint32_t>(scene.lights.size());
  for (std::uint32_t i = 0; i < count; ++i) scene.lights[i] = light_at(seed, count, i, seconds);
}

}  // namespace kaamos::effects
