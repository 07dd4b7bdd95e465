// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/terrain.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <utility>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/common/sampling.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

constexpr double kLevelHalf = 200.0;  // metres, of the level ground
constexpr double kEye = 0x1p-8;       // metres over the ground, of the first camera

// Multiples of 2^-24 m: sums with a whole offset of up to 10^8 m, and their differences, are exact
// in double.
glm::dvec3 snapped(const glm::dvec3& at) {
  return glm::round(at * 0x1p24) * 0x1p-24;
}

double corner(std::uint32_t seed, int x, int z) {
  return unit_float(hash_combine(hash_combine(seed, static_cast<std::uint32_t>(x)),
                                 static_cast<std::uint32_t>(z)));
}

// Smooth between random corners a unit apart. [Perlin 2002: the quintic]
double noise(std::uint32_t seed, double x, double z) {
  const double fx = std::floor(x), fz = std::floor(z);
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const double u = fade(x - fx), v = fade(z - fz);
  const int i = static_cast<int>(fx), j = static_cast<int>(fz);
  return glm::mix(glm::mix(corner(seed, i, j), corner(seed, i + 1, j), u),
                  glm::mix(corner(seed, i, j + 1), corner(seed, i + 1, j + 1), u), v);
}

// Metres. Level for 300 m about the middle, where it stays below the level ground.
double height(std::uint32_t seed, double x, double z) {
  double sum = 0, scale = 250.0, size = 2400.0;
  for (std::uint32_t octave = 0; octave < 5; ++octave) {
    sum += scale * noise(seed + octave, x / size, z / size);
    scale *= 0.45;
    size *= 0.5;
  }
  const double far = std::max(std::abs(x), std::abs(z));
  const double rise = std::clamp((far - 300.0) / 2500.0, 0.0, 1.0);
  return sum * rise * rise - 1.0;
}

}  // namespace

Scene make_terrain(const TerrainDesc& desc) {
  Scene scene = start_scene("terrain");
  scene.sky = default_sky();
  scene.sun = default_sun();
  scene.sun->direction_to_sun = glm::normalize(
      glm::vec3(glm::dvec3(-std::cos(desc.sun_elevation), std::sin(desc.sun_elevation), 0.25)));
  scene.sun->angular_radius = 0.0f;
  const std::uint32_t grass = add_paint(scene, "grass", {0.32f, 0.36f, 0.2f});
  const std::uint32_t sand = add_paint(scene, "sand", {0.5f, 0.45f, 0.34f});
  const std::uint32_t stone = add_paint(scene, "stone", {0.55f, 0.5f, 0.46f});
  const double half = 0.5 * kTerrainSize;
  Shape hills = patch({-half, 0, half}, {kTerrainSize, 0, 0}, {0, 0, -kTerrainSize},
                      static_cast<int>(kTerrainCells), static_cast<int>(kTerrainCells));
  for (Vertex& vertex : hills.vertices) {
    const double x = vertex.position.x, z = vertex.position.z, step = 10.0;
    const auto at = [&](double dx, double dz) { return height(desc.seed, x + dx, z + dz); };
    vertex.position.y = static_cast<float>(at(0, 0));
    vertex.normal = glm::vec3(glm::normalize(
        glm::dvec3(at(-step, 0) - at(step, 0), 2 * step, at(0, -step) - at(0, step))));
  }
  const glm::dmat4 place = translate(desc.offset);
  add_thing(scene, "hills", std::move(hills), grass, place);
  add_floor(scene, "level ground", {-kLevelHalf, -kLevelHalf}, {kLevelHalf, kLevelHalf}, 0.0, sand)
      .transform = place;
  // One mesh, scaled from 1e-3 to 1e3.
  const std::uint32_t tower = add_mesh(scene, "tower", box({0.12, 0.5, 0.12}), stone);
  for (std::uint32_t i = 0; i < kTowers; ++i) {
    const double size = kLeastTower * std::pow(10.0, i);
    // Beside each other in the picture, on the ground or as deep in the hills as they are wide.
    const double side = (static_cast<double>(i) - 3.0) * 0.45 * size, away = -3.0 * size;
    const double ground =
        3.0 * size < kLevelHalf ? 0.0 : height(desc.seed, side, away) - 0.1 * size;
    add_instance(scene, "tower " + std::to_string(i), tower,
                 place * translate(snapped({side, ground + 0.5 * size, away})) * rotate_y(0.4) *
                     glm::dmat4(glm::dmat3(size)));
  }
  add_view(scene, "ground", desc.offset + glm::dvec3(0, kEye, 0),
           desc.offset + glm::dvec3(0, kEye + 0.25, -1), 0.95);
  add_view(scene, "air", desc.offset + glm::dvec3(-2600, 1500, 4200),
           desc.offset + glm::dvec3(0, 100, 0), 0.9);
  scene.cameras[0].near_plane = 1e-4;
  return scene;
}

}  // namespace kaamos::effects
