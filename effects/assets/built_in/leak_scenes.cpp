// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/leak_scenes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <utility>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr int kDomeSegments = 64, kDomeRings = 32;

std::uint32_t add_color(Scene& scene, const char* name, const glm::vec3& color,
                        const glm::vec3& emissive = glm::vec3(0.0f)) {
  MaterialConstants constants;
  constants.base_color = glm::vec4(color, 1.0f);
  constants.emissive = emissive;
  return add_material(scene, name, constants);
}

// From below the floor up the outside and down the inside. The open dome has an edge at its
// opening.
Shape shell(const ThinDomeDesc& desc) {
  const double outer = kDomeRadius + desc.thickness, foot = -0.05;
  const double top = desc.sealed ? 0.5 * kPi : std::acos(kOculusRadius / kDomeRadius);
  std::vector<glm::dvec2> profile = {{outer, foot}};
  const auto add_ring = [&](double radius, int i) {
    const double angle = top * i / kDomeRings;
    const bool pole = desc.sealed && i == kDomeRings;
    profile.emplace_back(pole ? 0.0 : radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int i = 0; i <= kDomeRings; ++i) add_ring(outer, i);
  for (int i = kDomeRings; i >= 0; --i) add_ring(kDomeRadius, i);
  profile.emplace_back(kDomeRadius, foot);
  return revolve(profile, kDomeSegments);
}

// Half the thickness of a rib is inside the shell.
Shape rib(const ThinDomeDesc& desc, double azimuth) {
  const double radius = kDomeRadius + desc.thickness + 0.02;
  std::vector<glm::dvec3> path;
  for (int i = 0; i <= 24; ++i) {
    const double angle = 0.02 + (std::acos(kOculusRadius / kDomeRadius) - 0.04) * i / 24;
    path.emplace_back(radius * std::cos(angle) * std::cos(azimuth), radius * std::sin(angle),
                      radius * std::cos(angle) * std::sin(azimuth));
  }
  return tube(
      path, [](double) { return 0.02; }, 6);
}

}  // namespace

Scene make_thin_dome(const ThinDomeDesc& desc) {
  Scene scene = start_scene(desc.sealed ? "thin-dome-sealed" : "thin-dome");
  scene.sky = {
      .zenith = glm::vec3(1.0f, 1.1f, 1.3f), .horizon = glm::vec3(1.0f), .ground = glm::vec3(0.1f)};
  scene.exposure = 6.0f;
  const std::uint32_t stone = add_color(scene, "stone", glm::vec3(0.5f));
  const std::uint32_t plaster = add_color(scene, "plaster", glm::vec3(0.7f, 0.66f, 0.6f));
  const std::uint32_t lamp = add_color(scene, "rib", glm::vec3(0.0f), glm::vec3(8, 6, 3));
  const double half = 1.5 * kDomeRadius;
  add_thing(scene, "floor", patch({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, 1, 1),
            stone);
  add_thing(scene, "shell", shell(desc), plaster);
  for (int i = 0; i < 8; ++i) {
    add_thing(scene, "rib " + std::to_string(i), rib(desc, kPi / 8 + i * kPi / 4), lamp);
  }
  add_view(scene, "middle", {0, 1.6, 0}, {0, 3.4, -3.0}, 1.2);
  return scene;
}

Scene make_sealed_cells(const SealedCellsDesc& desc) {
  Scene scene = start_scene("sealed-cells");
  const double t = desc.thickness, pitch = kSealedRoomSize + t, half = 1.5 * pitch + 0.5 * t;
  const double height = kSealedRoomSize;
  const std::uint32_t grey = add_color(scene, "grey", glm::vec3(0.6f));
  const std::uint32_t wall = add_color(scene, "wall", glm::vec3(0.7f, 0.65f, 0.6f));
  add_box(scene, "floor", {-half, -t, -half}, {half, 0, half}, grey);
  add_box(scene, "roof", {-half, height, -half}, {half, height + t, half}, grey);
  // The walls end inside the floor and the roof, so that no edges have to match.
  for (int i = 0; i < 4; ++i) {
    const double at = (i - 1.5) * pitch;
    add_box(scene, "wall x" + std::to_string(i), {at - 0.5 * t, -0.5 * t, -half},
            {at + 0.5 * t, height + 0.5 * t, half}, wall);
    add_box(scene, "wall z" + std::to_string(i), {-half, -0.5 * t, at - 0.5 * t},
            {half, height + 0.5 * t, at + 0.5 * t}, wall);
  }
  Light light;
  light.name = "lamp";
  light.intensity = 10.0f;
  light.position = {0.3, 1.6, 0.2};
  light.radius = 0.05f;
  scene.lights.push_back(light);
  add_view(scene, "dark room", {0.6, 1.5, pitch + 0.8}, {-0.1, 0.7, pitch - 0.8}, 1.3);
  add_view(scene, "lit room", {0.85, 1.5, 0.85}, {-0.3, 0.7, -0.5}, 1.3);
  return scene;
}

Scene make_sealed_hall(const SealedHallDesc& desc) {
  Scene scene = start_scene(desc.lit ? "lit-hall" : "sealed-hall");
  scene.sky = {.zenith = glm::vec3(0.5f, 0.7f, 1.1f),
               .horizon = glm::vec3(0.9f, 1.0f, 1.2f),
               .ground = glm::vec3(0.3f)};
  scene.sun = Sun{};
  const std::uint32_t grey = add_color(scene, "grey", glm::vec3(kHallAlbedo));
  const glm::dvec3 low(-0.5 * kHallSize.x, 0, -0.5 * kHallSize.z), high = low + kHallSize;
  const glm::dvec3 outer_low = low - kHallWall, outer_high = high + kHallWall;
  add_box(scene, "floor", outer_low, {outer_high.x, 0, outer_high.z}, grey);
  add_box(scene, "roof", {outer_low.x, high.y, outer_low.z}, outer_high, grey);
  // The walls end inside the floor, the roof and each other, so that no edges have to match.
  const double inside = 0.5 * kHallWall;
  const double foot = -inside, top = high.y + inside;
  add_box(scene, "wall -x", {outer_low.x, foot, outer_low.z}, {low.x, top, outer_high.z}, grey);
  add_box(scene, "wall +x", {high.x, foot, outer_low.z}, {outer_high.x, top, outer_high.z}, grey);
  add_box(scene, "wall -z", {low.x - inside, foot, outer_low.z}, {high.x + inside, top, low.z},
          grey);
  add_box(scene, "wall +z", {low.x - inside, foot, high.z}, {high.x + inside, top, outer_high.z},
          grey);
  if (desc.lit) {
    Light light;
    light.name = "lamp";
    light.intensity = kHallLamp;
    light.position = {0, 8, 0};
    light.range = 1e3f;  // no loss of flux at the edge of the range
    light.radius = 0.1f;
    scene.lights.push_back(light);
  }
  add_view(scene, "middle", {4, 3, 5}, {-3, 1.5, -6}, 1.2);
  return scene;
}

}  // namespace kaamos::effects
