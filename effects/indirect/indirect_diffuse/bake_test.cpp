// SPDX-License-Identifier: MIT
// Tests what a bake counts, and how many paths it spends where.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "effects/assets/built_in/leak_scenes.h"
#include "effects/assets/scene/shapes.h"
#include "effects/indirect/indirect_diffuse/cell_budget.h"
#include "effects/indirect/indirect_diffuse/indirect_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

std::string backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

class Bakes : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Backends, Bakes, testing::Values("embree", "vulkan"), backend_name);

// A plane and a ball over it, lit by all there is: a sun, a sky, two lamps, and the ball itself.
Scene bright_scene() {
  Scene scene = small_scene(0.3f);
  scene.materials.resize(1);
  scene.materials[0].constants = {};
  scene.materials[0].constants.base_color = glm::vec4(0.7f, 0.5f, 0.3f, 1);
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].constants.emissive = glm::vec3(0.4f);
  scene.meshes[1].geometries[0].material = 1;
  scene.sun = Sun{};
  for (const double x : {-2.0, 2.0}) {
    Light lamp;
    lamp.position = {x, 1.5, 0};
    lamp.intensity = 5;
    lamp.radius = 0.3f;
    scene.lights.push_back(lamp);
  }
  return scene;
}

BakeDesc with_lights(std::uint32_t lights, std::uint32_t samples = 4) {
  BakeDesc desc;
  desc.samples = samples;
  desc.error = 0;
  desc.lights = lights;
  return desc;
}

glm::dvec3 total(const IndirectVolume& volume) {
  glm::dvec3 sum(0);
  for (const VolumeCell& cell : volume.cells) sum += glm::dvec3(cell.mean);
  return sum;
}

// The same paths with one kind of light at a time add up to those with all, cell by cell.
TEST_P(Bakes, AddUpTheLightsThatAreChosen) {
  if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  Stage stage(bright_scene(), 4, 4, GetParam());
  const IndirectVolume all = stage.bake(1.0f, with_lights(kBakeAll));
  std::vector<glm::dvec3> sums(all.cells.size(), glm::dvec3(0));
  for (const std::uint32_t kind : {kBakeSun, kBakeSky, kBakeLocal, kBakeEmissive}) {
    const IndirectVolume part = stage.bake(1.0f, with_lights(kind));
    EXPECT_GT(total(part).x, 1.0) << kind;
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += glm::dvec3(part.cells[i].mean);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(sums[i][c], all.cells[i].mean[c], 1e-4 * (1 + sums[i][c])) << i;
    }
  }
  EXPECT_EQ(total(stage.bake(1.0f, with_lights(0))), glm::dvec3(0));
}

// A lamp that is not baked counts as little as one that is not there.
TEST_P(Bakes, LeaveOutLampsThatAreSwitched) {
  if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  Scene without = bright_scene(), switched = bright_scene();
  without.lights.pop_back();
  switched.lights.back().baked = false;
  const IndirectVolume a = Stage(without, 4, 4, GetParam()).bake(1.0f, with_lights(kBakeLocal));
  const IndirectVolume b = Stage(switched, 4, 4, GetParam()).bake(1.0f, with_lights(kBakeLocal));
  EXPECT_GT(total(a).x, 1.0);
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    ASSERT_EQ(a.cells[i].mean, b.cells[i].mean) << i;
  }
}

// A moving board over the plane neither shades nor lights the volume.
TEST_P(Bakes, LeaveOutWhatMoves) {
  if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  Scene still = bright_scene(), moving = bright_scene();
  Mesh mesh;
  add_shape(mesh, box({2, 0.1, 2}), 1);
  Instance board;
  board.mesh = static_cast<std::uint32_t>(moving.meshes.size());
  board.transform = translate({0, 1, 0});
  moving.meshes.push_back(mesh);
  moving.instances.push_back(board);
  moving.nodes.emplace_back();
  moving.instances.back().motion.node = 0;
  const IndirectVolume a = Stage(still, 4, 4, GetParam()).bake(1.0f, with_lights(kBakeAll));
  const IndirectVolume b = Stage(moving, 4, 4, GetParam()).bake(1.0f, with_lights(kBakeAll));
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    ASSERT_EQ(a.cells[i].mean, b.cells[i].mean) << i;
  }
  moving.instances.back().motion = {};
  const IndirectVolume c = Stage(moving, 4, 4, GetParam()).bake(1.0f, with_lights(kBakeAll));
  int different = 0;
  for (std::size_t i = 0; i < a.cells.size(); ++i) different += c.cells[i].mean != a.cells[i].mean;
  EXPECT_GT(different, 200);
}

// An error bound saves paths, keeps what it promises, and makes nothing darker.
TEST(Bakes, StopWhereTheErrorIsSmallEnough) {
  Stage stage(bright_scene(), 4, 4);
  BakeDesc desc;
  desc.samples = 1024;
  desc.error = 0;
  BakeStatistics full, bounded;
  const IndirectVolume all = stage.bake(1.0f, desc, &full);
  desc.error = 0.05f;
  desc.seed = 1;
  const IndirectVolume some = stage.bake(1.0f, desc, &bounded);
  std::printf("%llu cells: %.0f paths each to %.3f, %.0f to %.3f\n",
              static_cast<unsigned long long>(full.cells),
              static_cast<double>(full.paths) / static_cast<double>(full.cells), full.error,
              static_cast<double>(bounded.paths) / static_cast<double>(bounded.cells),
              bounded.error);
  EXPECT_EQ(full.paths, full.cells * 1024);
  EXPECT_LT(bounded.paths, full.paths / 2);
  EXPECT_GT(bounded.at_bound, bounded.cells / 2);
  EXPECT_LE(bounded.error, 0.06);
  const double bright = total(all).x, found = total(some).x;
  EXPECT_NEAR(found, bright, 0.01 * bright);
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < all.cells.size(); ++i) {
    if (all.cells[i].validity == 0 || some.cells[i].validity == 0) continue;
    squares += std::pow(some.cells[i].mean.x / all.cells[i].mean.x - 1, 2);
    ++count;
  }
  EXPECT_LT(std::sqrt(squares / count), 0.07);
}

// Halves of cells with a mean of 1 and a given variance.
std::vector<CellSums> pilot_of(const std::vector<double>& variances) {
  std::vector<CellSums> pilot;
  for (const double variance : variances) {
    CellSums sums;
    sums.mean = glm::vec3(static_cast<float>(kPilotSamples));
    sums.luminance_squared =
        static_cast<float>(kPilotSamples * (1 + variance * (kPilotSamples - 1) / kPilotSamples));
    pilot.push_back(sums);
  }
  return pilot;
}

TEST(CellBudgets, FollowTheVariance) {
  BakeDesc desc;
  desc.samples = 1000;
  desc.error = 0.1f;
  const std::vector<std::uint32_t> cells = {0, 7 * 64, 511};  // none next to another
  const auto samples = samples_of_halves(cells, pilot_of({1, 1, 4, 4, 1e4, 1e4}), desc);
  // Both halves together need variance / error^2.
  EXPECT_NEAR(samples[0], 50, 1);
  EXPECT_NEAR(samples[2], 200, 1);
  EXPECT_EQ(samples[4], 500u);
  desc.error = 10;
  EXPECT_EQ(samples_of_halves(cells, pilot_of({1, 1, 4, 4, 1, 1}), desc),
            std::vector<std::uint32_t>(6, kPilotSamples));
}

// A half whose own samples look dark and even gets no fewer, and its other half's do.
TEST(CellBudgets, DoNotDependOnTheHalfItself) {
  BakeDesc desc;
  desc.samples = 2000;
  desc.error = 0.05f;
  const std::vector<std::uint32_t> cells = {0, 1, 2};
  const auto before = samples_of_halves(cells, pilot_of({1, 1, 1, 1, 1, 1}), desc);
  const auto after = samples_of_halves(cells, pilot_of({1, 1, 3, 1, 1, 1}), desc);
  EXPECT_EQ(after[2], before[2]);
  EXPECT_GT(after[3], 2 * before[3]);
  EXPECT_GT(after[0], before[0]) << "the cell beside it";
}

TEST(CellBudgets, SpendNothingInSolids) {
  BakeDesc desc;
  desc.samples = 1000;
  desc.error = 0.01f;
  std::vector<CellSums> pilot = pilot_of({1, 1, 1, 1});
  for (std::size_t half = 2; half < 4; ++half) pilot[half].back_faces = 0.9f * kPilotSamples;
  const auto samples = samples_of_halves({0, 100}, pilot, desc);
  EXPECT_EQ(samples[0], 500u);
  EXPECT_EQ(samples[2], kPilotSamples);
  EXPECT_EQ(samples[3], kPilotSamples);
}

}  // namespace
}  // namespace kaamos::effects
