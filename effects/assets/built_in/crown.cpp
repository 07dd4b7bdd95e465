// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/crown.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

constexpr double kPi = glm::pi<double>();

// Up the outside with two rims and a deep groove between them, over the top, down the inside.
Shape band() {
  const double r = kCrownRadius;
  const glm::dvec2 profile[] = {
      {r - 0.03, 0.0},  {r, 0.0},          {r + 0.03, 0.02}, {r + 0.035, 0.05}, {r + 0.03, 0.08},
      {r + 0.005, 0.1}, {r + 0.005, 0.28}, {r + 0.03, 0.3},  {r + 0.035, 0.32}, {r + 0.03, 0.335},
      {r, 0.345},       {r - 0.02, 0.35},  {r, 0.355},       {r + 0.03, 0.365}, {r + 0.03, 0.4},
      {r + 0.01, 0.42}, {r - 0.03, 0.42},  {r - 0.03, 0.0}};
  return revolve(profile, 128, 0.4);
}

// A four-sided spike like a cut gem: a short foot, wide shoulders, a point.
Shape spike(double height) {
  const glm::dvec2 profile[] = {
      {0.0, 0.0}, {0.02, 0.0}, {0.045, 0.35 * height}, {0.02, 0.75 * height}, {0.0, height}};
  return revolve(profile, 4, 0.0);
}

Shape gem() {
  const glm::dvec2 profile[] = {{0.0, -0.04}, {0.035, 0.0}, {0.025, 0.018}, {0.0, 0.022}};
  return revolve(profile, 8, 0.0);
}

// The lining: a dome of velvet that closes the crown within.
Shape lining() {
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= 12; ++i) {
    const double angle = 0.5 * kPi * i / 12;
    profile.emplace_back(i == 12 ? 0.0 : (kCrownRadius - 0.035) * std::cos(angle),
                         0.08 + 0.25 * std::sin(angle));
  }
  return revolve(profile, 64);
}

}  // namespace

Scene make_crown() {
  Scene scene = start_scene("crown");
  scene.sky = default_sky();
  scene.sun = default_sun();
  scene.exposure = 0.5f;
  const std::uint32_t plane = add_paint(scene, "plane", glm::vec3(0.6f));
  const std::uint32_t gold = add_paint(scene, "gold", {0.85f, 0.62f, 0.24f}, 0.35f);
  const std::uint32_t velvet = add_paint(scene, "velvet", {0.35f, 0.04f, 0.08f}, 0.95f);
  const std::uint32_t ruby = add_paint(scene, "ruby", {0.6f, 0.05f, 0.1f}, 0.15f);
  add_floor(scene, "plane", {-20, -20}, {20, 20}, 0.0, plane);
  add_thing(scene, "band", band(), gold);
  add_thing(scene, "lining", lining(), velvet);
  const std::uint32_t tall = add_mesh(scene, "tall spike", spike(0.34), gold);
  const std::uint32_t low = add_mesh(scene, "low spike", spike(0.2), gold);
  const std::uint32_t stone = add_mesh(scene, "gem", gem(), ruby);
  for (std::uint32_t i = 0; i < kCrownSpikes; ++i) {
    const bool is_tall = i % 2 == 0;
    // They lean outwards.
    const glm::dmat4 place = rotate_y(2.0 * kPi * i / kCrownSpikes) *
                             translate({0, 0.415, kCrownRadius - 0.01}) * rotate_x(0.2);
    add_instance(scene, "spike " + std::to_string(i), is_tall ? tall : low, place);
    if (is_tall) {
      add_instance(scene, "gem " + std::to_string(i), stone, place * translate({0, 0.385, 0}));
    }
  }
  // Gems along the band between its rims.
  for (std::uint32_t i = 0; i < kCrownSpikes / 2; ++i) {
    add_instance(scene, "band gem " + std::to_string(i), stone,
                 rotate_y(4.0 * kPi * (i + 0.5) / kCrownSpikes) *
                     translate({0, 0.19, kCrownRadius + 0.005}) * rotate_x(0.5 * kPi));
  }
  add_view(scene, "crown", {0.9, 1.15, 1.6}, {0, 0.28, 0}, 0.75);
  return scene;
}

}  // namespace kaamos::effects
