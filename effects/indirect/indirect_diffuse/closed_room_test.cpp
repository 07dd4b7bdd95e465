// SPDX-License-Identifier: MIT
// A closed hall that is much larger than the cells of a volume, without a lamp and with one: no
// light of the sky gets in, also where no geometry is near.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <string>

#include "effects/assets/built_in/leak_scenes.h"
#include "effects/assets/scene/shapes.h"
#include "effects/indirect/indirect_diffuse/indirect_fixture.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/reflections/traced/reflections.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

constexpr float kCell = 0.5f;
// Longer than the 4 m that the finest bricks reach at most from a wall.
constexpr float kRayMetres = 6.0f;

// Backend independent, so it is baked once.
const IndirectVolume& hall_volume(bool lit) {
  static const IndirectVolume volumes[2] = {
      Stage(make_sealed_hall({.lit = false}), 4, 4).bake(kCell, 16),
      Stage(make_sealed_hall({.lit = true}), 4, 4).bake(kCell, 16)};
  return volumes[lit ? 1 : 0];
}

// The hall with a box that the volume does not know, in the middle of it.
Scene hall_with_box(bool lit) {
  Scene scene = make_sealed_hall({.lit = lit});
  Mesh mesh;
  mesh.name = "box";
  add_shape(mesh, box({0.8, 0.8, 0.8}), 0);
  Instance added;
  added.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  added.transform = translate({0, 5, -1});
  scene.meshes.push_back(mesh);
  scene.instances.push_back(added);
  scene.cameras.front().camera_to_world = look_at({0, 5, 4}, {0, 5, -1});
  scene.cameras.front().vertical_fov = 0.3;
  return scene;
}

std::string backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

class ClosedRooms : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Backends, ClosedRooms, testing::Values("embree", "vulkan"), backend_name);

// Mean light in one mode, in the hall as it is made.
double gathered(const std::string& backend, bool lit, IndirectMode how) {
  Stage stage(make_sealed_hall({.lit = lit}), 16, 12, backend);
  return mean_of(stage.gather(hall_volume(lit), mode(how, kRayMetres), 32), stage.ids);
}

double on_box(const std::string& backend, bool lit) {
  Stage stage(hall_with_box(lit), 16, 12, backend);
  return mean_of(stage.gather(hall_volume(lit), mode(IndirectMode::kDirect), 1), stage.ids);
}

// Rays that end in the air, off metal that is rough enough for them to be short.
double reflected(const std::string& backend, bool lit) {
  Scene scene = make_sealed_hall({.lit = lit});
  for (Material& material : scene.materials) {
    material.constants.metallic = 1;
    material.constants.roughness = 0.8f;
  }
  FrameSettings settings;
  settings.width = 16;
  settings.height = 12;
  settings.effects = choose_effects({"reflections"});
  settings.volume.given = std::make_shared<IndirectVolume>(hall_volume(lit));
  rtapi::DeviceDesc desc;
  desc.Backend = backend;
  const auto renderer = FrameRenderer::create(test::device_for(desc), scene, settings).value();
  constexpr std::uint32_t kRays = 32;
  renderer->run("reflections", kRays).value();
  return mean_of(renderer->read(renderer->effects().sum("reflection")).value(),
                 renderer->read("ids").value()) /
         kRays;
}

void expect_dark(const char* what, double dark, double lit) {
  std::printf("%s: %.5f in the dark hall, %.5f in the lit one\n", what, dark, lit);
  EXPECT_GT(lit, 0.1);
  EXPECT_LE(dark, 0.01 * lit);
}

TEST_P(ClosedRooms, AreDarkAtTheEndsOfRays) {
  if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  const auto in = [&](bool lit) { return gathered(GetParam(), lit, IndirectMode::kHitBlack); };
  expect_dark("hit = black", in(false), in(true));
}

TEST_P(ClosedRooms, AreDarkWhereHitsAreLit) {
  if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  const auto in = [&](bool lit) { return gathered(GetParam(), lit, IndirectMode::kNearField); };
  expect_dark("near-field", in(false), in(true));
}

TEST_P(ClosedRooms, AreDarkOnThingsFarFromWalls) {
  if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  expect_dark("volume alone", on_box(GetParam(), false), on_box(GetParam(), true));
}

TEST_P(ClosedRooms, AreDarkInReflections) {
  if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  expect_dark("reflections", reflected(GetParam(), false), reflected(GetParam(), true));
}

// Walls get from each other what the lamp's flux leaves after all bounces: see make_sealed_hall.
double on_walls(const IndirectVolume& volume) {
  const std::vector<glm::dvec3> centers = volume.cell_centers();
  const glm::dvec3 half = 0.5 * kHallSize;
  double sum = 0, weights = 0;
  for (const std::uint32_t i : volume.cells_in_use()) {
    const glm::dvec3 from_middle = centers[i] - glm::dvec3(0, half.y, 0);
    const VolumeCell& cell = volume.cells[i];
    for (int axis = 0; axis < 3; ++axis) {
      // The cells at a wall: their number goes with its area.
      const double off = half[axis] - std::abs(from_middle[axis]);
      const glm::dvec3 others = glm::abs(from_middle) - half;
      if (off < 0 || off >= static_cast<double>(kCell)) continue;
      if (others[(axis + 1) % 3] > 0 || others[(axis + 2) % 3] > 0) continue;
      EXPECT_EQ(cell.validity, 1.0f);
      const glm::vec3 slopes[3] = {cell.slope_x, cell.slope_y, cell.slope_z};
      const float inwards = from_middle[axis] > 0 ? -1.0f : 1.0f;
      sum += static_cast<double>(cell.mean.x + inwards * 2 / 3 * slopes[axis].x);
      ++weights;
    }
  }
  return sum / weights;
}

TEST(IndirectVolumes, KeepTheEnergyOfAClosedRoom) {
  const double area =
      2 * (kHallSize.x * kHallSize.y + kHallSize.y * kHallSize.z + kHallSize.z * kHallSize.x);
  const double albedo = static_cast<double>(kHallAlbedo);
  // Irradiance / pi: 4 pi candela over pi.
  const double from_lamp = 4 * static_cast<double>(kHallLamp) / area;
  const double expected = from_lamp * albedo / (1 - albedo);
  const double found = on_walls(hall_volume(true));
  std::printf("irradiance / pi in the lit hall: %.4f, expected %.4f\n", found, expected);
  EXPECT_NEAR(found, expected, 0.04 * expected);
}

// Radiance that the walls reflect of the lamp's own light towards `from`, seen in a direction.
double reflected_once(const glm::dvec3& from, const glm::dvec3& direction) {
  const glm::dvec3 middle(0, 0.5 * kHallSize.y, 0), half = 0.5 * kHallSize;
  double distance = 1e30;
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    const double wall = middle[i] + (direction[i] > 0 ? half[i] : -half[i]);
    const double t = (wall - from[i]) / direction[i];
    if (direction[i] == 0 || t >= distance) continue;
    distance = t;
    axis = i;
  }
  const glm::dvec3 to_lamp = glm::dvec3(0, 8, 0) - (from + distance * direction);
  const double far = glm::length(to_lamp);
  return static_cast<double>(kHallAlbedo) / glm::pi<double>() * static_cast<double>(kHallLamp) *
         std::abs(to_lamp[axis]) / (far * far * far);
}

// After a single bounce, what a cell holds is an integral over the walls.
TEST(IndirectVolumes, HoldTheLampsLightFromTheWalls) {
  const IndirectVolume volume = Stage(make_sealed_hall({.lit = true}), 4, 4).bake(kCell, 64, 0);
  const std::vector<glm::dvec3> centers = volume.cell_centers();
  double found = 0, expected = 0, slope = 0, expected_slope = 0;
  int count = 0;
  for (const std::uint32_t i : volume.cells_in_use()) {
    const glm::dvec3 from_middle = glm::abs(centers[i] - glm::dvec3(0, 0.5 * kHallSize.y, 0));
    const glm::dvec3 gap = 0.5 * kHallSize - from_middle;
    if (std::min({gap.x, gap.y, gap.z}) < 0.3 || i % 16 != 0) continue;
    constexpr int kSteps = 24;
    for (int step = 0; step < 2 * kSteps * kSteps; ++step) {
      const double z = 1 - (2 * (step % kSteps) + 1.0) / kSteps;
      const double phi = glm::pi<double>() * (step / kSteps + 0.5) / kSteps;
      const double r = std::sqrt(1 - z * z);
      const glm::dvec3 direction(r * std::cos(phi), z, r * std::sin(phi));
      const double radiance = reflected_once(centers[i], direction) / (2.0 * kSteps * kSteps);
      expected += radiance;
      expected_slope += 3 * radiance * z;
    }
    found += static_cast<double>(volume.cells[i].mean.x);
    slope += static_cast<double>(volume.cells[i].slope_y.x);
    ++count;
  }
  ASSERT_GT(count, 1000);
  std::printf("%d cells: mean %.5f, expected %.5f; vertical slope %.5f, expected %.5f\n", count,
              found / count, expected / count, slope / count, expected_slope / count);
  EXPECT_NEAR(found, expected, 0.005 * expected);
  EXPECT_NEAR(slope, expected_slope, 0.005 * expected);
}

}  // namespace
}  // namespace kaamos::effects
