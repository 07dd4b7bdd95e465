// SPDX-License-Identifier: MIT
// Small studies, and scenes whose answers are known in closed form.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/built_in/scene_parts.h"
#include "effects/measure/study/files.h"
#include "effects/measure/study/study.h"

namespace kaamos::measure::fixture {

using namespace effects;

inline constexpr std::uint32_t kWidth = 48, kHeight = 32;

inline Options quick_study(const std::string& scene, const std::string& family) {
  Options options = default_options();
  options.scene = scene;
  options.frame.width = kWidth;
  options.frame.height = kHeight;
  options.frame.volume.samples = 64;
  options.families = {family};
  options.quick = true;
  options.repeats = 4;
  options.measure_reference = 1024;
  options.measure_truth = 1024;
  options.seeds = 2;
  options.command = "northlight --study " + scene;
  options.out =
      testing::TempDir() + "study_" + testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::remove_all(options.out);
  return options;
}

inline std::vector<StudyResult> study(const Scene& scene, const Options& options) {
  std::string said;
  const auto done = run_study(
      options, scene, [](const std::string&, double) { return true; }, said);
  if (!done) throw std::runtime_error(done.error().message);
  auto results = parse_results(read_text(options.out + "/study.json"));
  return results ? *results : std::vector<StudyResult>();
}

// The row of a setting, such as "sun/1 ray", in a family, such as "shadows" or "ao-0.5m".
inline const StudyRow& row_of(const std::vector<StudyResult>& results, const std::string& family,
                              const std::string& setting) {
  for (const StudyResult& result : results) {
    if (result.family != family) continue;
    for (const StudyRow& row : result.rows) {
      if (row.effect + "/" + row.label == setting) return row;
    }
  }
  throw std::runtime_error("no row " + setting + " in " + family);
}

// The direction of the ray through the middle of each pixel.
inline std::vector<glm::dvec3> ways_of(const Camera& camera) {
  std::vector<glm::dvec3> out;
  const double half = std::tan(0.5 * camera.vertical_fov);
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const double right = ((x + 0.5) / kWidth * 2 - 1) * half * kWidth / kHeight;
      const double up = (1 - (y + 0.5) / kHeight * 2) * half;
      out.emplace_back(camera.camera_to_world * glm::dvec4(right, up, -1, 0));
    }
  }
  return out;
}

// A floor below a sheet with a straight edge, as in make_penumbra_oracle, but small enough for the
// texels of shadow maps, and turned, so that the edge crosses them.
struct Penumbra {
  double height = 2, angular_radius = 0.1, turn = 0.37;

  Scene make_scene() const {
    Scene scene = start_scene("penumbra");
    const std::uint32_t white = add_paint(scene, "white", glm::vec3(0.8f));
    scene.materials[white].constants.flags = kMaterialDoubleSided;
    add_floor(scene, "plane", {-3, -3}, {3, 3}, 0, white);
    Instance& sheet = add_floor(scene, "edge", {-4, -4}, {0, 4}, 0, white);
    sheet.transform =
        glm::rotate(glm::translate(glm::dmat4(1), {0, height, 0}), turn, glm::dvec3(0, 1, 0));
    scene.sun =
        Sun{.direction_to_sun = {0, 1, 0}, .angular_radius = static_cast<float>(angular_radius)};
    add_view(scene, "view", {1.2, 1.2, 0}, {0, 0, 0}, 0.5);
    return scene;
  }
  // Metres from below the edge to where a ray meets the floor; positive on the lit side.
  double place(const glm::dvec3& from, const glm::dvec3& way) const {
    const glm::dvec3 at = from - way * (from.y / way.y);
    return at.x * std::cos(turn) - at.z * std::sin(turn);
  }
  double visible(double at) const { return penumbra_visibility(height, angular_radius, at); }
};

// A mirror on the floor before a wall that alone is lit, by a sun at the horizon: what the mirror
// shows of it is albedo * irradiance / pi. No light comes back to the wall, and there is no sky.
inline Scene mirror_scene() {
  Scene scene = start_scene("mirror");
  const std::uint32_t mirror = add_material(
      scene, "mirror", {.base_color = glm::vec4(1, 1, 1, 1), .metallic = 1, .roughness = 0});
  const std::uint32_t paint = add_paint(scene, "paint", glm::vec3(0.5f), 1);
  scene.materials[paint].constants.specular = 0;  // only the floor mirrors
  add_floor(scene, "floor", {-2, -2}, {2, 2}, 0, mirror);
  add_thing(scene, "wall", patch({-8, 0, -2}, {16, 0, 0}, {0, 6, 0}, 1, 1), paint);
  scene.sun = Sun{.direction_to_sun = {0, 0, 1}, .irradiance = glm::vec3(2.0f)};
  scene.sky = Sky{};
  add_view(scene, "view", {0, 1.2, 2.5}, {0, 0.4, -2}, 0.9);
  return scene;
}

// A closed box whose faces emit 1 and reflect half: radiance is 2 everywhere, and so is what falls
// on a face, over pi.
inline Scene furnace_scene() {
  Scene scene = start_scene("furnace");
  const std::uint32_t wall = add_material(
      scene, "wall",
      {.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1), .emissive = glm::vec3(1), .roughness = 1});
  scene.materials[wall].constants.specular = 0;
  const glm::dvec3 x(4, 0, 0), y(0, 3, 0), z(0, 0, 4), low(-2, -1.5, -2), high(2, 1.5, 2);
  add_thing(scene, "floor", patch(low, z, x, 1, 1), wall);
  add_thing(scene, "left", patch(low, y, z, 1, 1), wall);
  add_thing(scene, "back", patch(low, x, y, 1, 1), wall);
  add_thing(scene, "ceiling", patch(high, -x, -z, 1, 1), wall);
  add_thing(scene, "right", patch(high, -z, -y, 1, 1), wall);
  add_thing(scene, "front", patch(high, -y, -x, 1, 1), wall);
  scene.sky = Sky{};
  add_view(scene, "view", {1, 0.2, 1.2}, {-0.5, -0.3, -1}, 1.0);
  return scene;
}

}  // namespace kaamos::measure::fixture
