// SPDX-License-Identifier: MIT
// Cells of several sizes in one volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "effects/assets/built_in/built_in.h"
#include "effects/assets/built_in/leak_scenes.h"
#include "effects/assets/scene/shapes.h"
#include "effects/indirect/indirect_diffuse/indirect_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

std::string backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

class VolumeLevels : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Backends, VolumeLevels, testing::Values("embree", "vulkan"), backend_name);

glm::ivec3 place_of(const IndirectVolume& volume, std::size_t brick) {
  return {brick % volume.bricks.x, brick / volume.bricks.x % volume.bricks.y,
          brick / (std::size_t{volume.bricks.x} * volume.bricks.y)};
}

std::uint32_t entry_at(const IndirectVolume& volume, const glm::ivec3& place) {
  const glm::ivec3 at = glm::clamp(place, glm::ivec3(0), glm::ivec3(volume.bricks) - 1);
  return volume.brick_starts[static_cast<std::size_t>(at.x) +
                             volume.bricks.x *
                                 (static_cast<std::size_t>(at.y) +
                                  std::size_t{volume.bricks.y} * static_cast<std::size_t>(at.z))];
}

// In all built-in scenes with cells of the default size, every place has cells, and neighbours
// differ by one level at most.
TEST(VolumeLayouts, CoverTheWholeScene) {
  std::set<std::uint32_t> levels;
  for (const BuiltInScene& built_in : built_in_scenes()) {
    const IndirectVolume volume = layout_volume(built_in.make()).value();
    const Bounds bounds = scene_bounds(built_in.make());
    const double size = static_cast<double>(volume.cell) * kBrickCells;
    EXPECT_TRUE(glm::all(glm::lessThan(volume.origin, bounds.min))) << built_in.name;
    EXPECT_TRUE(
        glm::all(glm::greaterThan(volume.origin + glm::dvec3(volume.bricks) * size, bounds.max)))
        << built_in.name;
    for (std::size_t i = 0; i < volume.brick_starts.size(); ++i) {
      const std::uint32_t entry = volume.brick_starts[i];
      ASSERT_NE(entry, kNoBrick) << built_in.name;
      ASSERT_LE(brick_start(entry) + kCellsPerBrick, volume.cells.size()) << built_in.name;
      levels.insert(brick_level(entry));
      for (int n = 0; n < 27; ++n) {
        const glm::ivec3 offset(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        const std::uint32_t next = entry_at(volume, place_of(volume, i) + offset);
        ASSERT_LE(brick_level(next), brick_level(entry) + 1) << built_in.name;
      }
    }
  }
  EXPECT_GE(levels.size(), 3u);
}

// No triangle's box comes nearer to what is read at level n > 0 than a cell of that level, so that
// the eight cells about a point are on its side of every wall.
TEST(VolumeLayouts, CoarseCellsAreAwayFromGeometry) {
  const Scene scene = make_sealed_hall({});
  const IndirectVolume volume = layout_volume(scene).value();
  const std::vector<glm::dvec3> centers = volume.cell_centers();
  std::vector<std::uint32_t> level_of(volume.cells.size() / kCellsPerBrick);
  for (const std::uint32_t entry : volume.brick_starts) {
    level_of[entry / kCellsPerBrick] = brick_level(entry);
  }
  int coarse = 0;
  for (const std::uint32_t cell : volume.cells_in_use()) {
    const std::uint32_t level = level_of[cell / kCellsPerBrick];
    if (level == 0) continue;
    const double size = static_cast<double>(volume.cell) * std::exp2(level);
    ++coarse;
    for (const Instance& instance : scene.instances) {
      const Bounds local = scene.meshes[instance.mesh].bounds();
      Bounds world;  // the hall's boxes are not turned
      world.add(glm::dvec3(instance.transform * glm::dvec4(local.min, 1)));
      world.add(glm::dvec3(instance.transform * glm::dvec4(local.max, 1)));
      const glm::dvec3 gap =
          glm::max(world.min - centers[cell], centers[cell] - world.max) - 0.5 * size;
      ASSERT_GE(std::max({gap.x, gap.y, gap.z}), size * (1 - 1e-4)) << "level " << level;
    }
  }
  EXPECT_GT(coarse, 10000);
}

TEST(VolumeLayouts, UseEachPlaceOnce) {
  const IndirectVolume volume = layout_volume(make_sealed_hall({})).value();
  std::vector<std::uint32_t> level_of(volume.cells.size() / kCellsPerBrick);
  for (const std::uint32_t entry : volume.brick_starts) {
    level_of[entry / kCellsPerBrick] = brick_level(entry);
  }
  // In cells of level 0. Coarse cells at the border of the grid reach beyond it.
  double used = 0;
  for (const std::uint32_t cell : volume.cells_in_use()) {
    used += std::exp2(3 * level_of[cell / kCellsPerBrick]);
  }
  const double grid = static_cast<double>(volume.brick_starts.size()) * kCellsPerBrick;
  EXPECT_GE(used, grid);
  EXPECT_LT(used, 1.5 * grid);
}

TEST(VolumeLayouts, LeaveOutWhatMoves) {
  Scene scene = small_scene(1.0f);
  scene.instances.resize(1);
  const IndirectVolume still = layout_volume(scene, 0.5f).value();
  Instance moving = scene.instances[0];
  moving.transform = translate({0, 9, 0});
  scene.nodes.emplace_back();
  moving.motion.node = 0;
  scene.instances.push_back(moving);
  const IndirectVolume with = layout_volume(scene, 0.5f).value();
  scene.instances.back().motion = {};
  const IndirectVolume stopped = layout_volume(scene, 0.5f).value();
  const auto finest = [](const IndirectVolume& v) {
    return std::count_if(v.brick_starts.begin(), v.brick_starts.end(),
                         [](std::uint32_t entry) { return brick_level(entry) == 0; });
  };
  EXPECT_EQ(finest(with), finest(still));
  EXPECT_GT(finest(stopped), finest(still));
}

TEST(VolumeLayouts, CellsInSolidsGetTheLightAroundThem) {
  IndirectVolume volume = layout_volume(make_sealed_hall({}), 1.0f).value();
  const std::vector<std::uint32_t> used = volume.cells_in_use();
  for (const std::uint32_t cell : used) volume.cells[cell] = {};
  VolumeCell& lone = volume.cells[used[used.size() / 2]];
  lone.mean = lone.slope_y = glm::vec3(3, 2, 1);
  lone.validity = 1;
  fill_solids(volume);
  int solid = 0;
  for (const std::uint32_t cell : used) {
    ASSERT_EQ(volume.cells[cell].mean, glm::vec3(3, 2, 1));
    ASSERT_EQ(volume.cells[cell].slope_y, glm::vec3(3, 2, 1));
    solid += volume.cells[cell].validity == 0;
  }
  EXPECT_EQ(static_cast<std::size_t>(solid) + 1, used.size());
  // Two valid cells: what is next to one of them is lit by that one alone.
  for (const std::uint32_t cell : used) volume.cells[cell] = {};
  volume.cells[used.front()].validity = volume.cells[used.back()].validity = 1;
  volume.cells[used.front()].mean = glm::vec3(1);
  fill_solids(volume);
  EXPECT_EQ(volume.cells[used.front() + 1].mean, glm::vec3(1));
  EXPECT_EQ(volume.cells[used.back() - 1].mean, glm::vec3(0));
}

// A floor, and far above it a small box, so that there is much air between.
Scene tall_scene() {
  Scene scene = small_scene(0.0f);
  scene.meshes.clear();
  scene.instances.clear();
  scene.materials.resize(1);
  scene.materials[0].constants = {};
  const auto add = [&](const glm::dvec3& low, const glm::dvec3& high) {
    Mesh mesh;
    add_shape(mesh, box((high - low) * 0.5), 0);
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    instance.transform = translate((low + high) * 0.5);
    scene.meshes.push_back(mesh);
    scene.instances.push_back(instance);
  };
  add({-8, -0.2, -8}, {8, 0, 8});
  add({7, 10, 7}, {8, 11, 8});
  return scene;
}

// A board that the volume does not know stands across all levels, in light that changes evenly
// along x, y and z. Within a level that is exact; where levels meet, a cell's light may stand for a
// place a part of a cell away.
TEST_P(VolumeLevels, MeetWithSmallSteps) {
  if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  IndirectVolume volume = layout_volume(tall_scene(), 0.25f).value();
  std::uint32_t coarsest = 0;
  for (const std::uint32_t entry : volume.brick_starts) {
    coarsest = std::max(coarsest, brick_level(entry));
  }
  ASSERT_GE(coarsest, 2u);
  const glm::dvec3 gradient(1, -2, 0.5);
  const auto light = [&](const glm::dvec3& p) { return 40 + glm::dot(gradient, p); };
  const std::vector<glm::dvec3> centers = volume.cell_centers();
  for (std::size_t i = 0; i < centers.size(); ++i) {
    volume.cells[i].mean = glm::vec3(static_cast<float>(light(centers[i])));
    volume.cells[i].validity = 1;
  }
  Scene scene = tall_scene();
  Mesh mesh;
  add_shape(mesh, patch({-6, 0.3, -2}, {12, 0, 3}, {0, 13, 0}, 1, 1), 0);
  Instance board;
  board.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(mesh);
  scene.instances.push_back(board);
  const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(12, 0, 3), glm::dvec3(0, 13, 0)));
  scene.cameras.front().camera_to_world =
      look_at(glm::dvec3(0, 6.8, -0.5) + 12.0 * normal, glm::dvec3(0, 6.8, -0.5));
  scene.cameras.front().vertical_fov = 1.0;
  Stage stage(scene, 24, 64, GetParam());
  const FloatImage direct = stage.gather(volume, mode(IndirectMode::kDirect), 1);
  const FloatImage picked = stage.gather(volume, mode(IndirectMode::kHitBlack, 1e-3f), 256);
  const FloatImage position = stage.frame.read(stage.device, stage.queue, kPosition).value();
  const glm::dvec3 eye = scene.cameras.front().position();
  double worst = 0, sum = 0;
  int exact = 0, count = 0;
  for (std::uint32_t y = 0; y < stage.height; ++y) {
    for (std::uint32_t x = 0; x < stage.width; ++x) {
      if (stage.ids.at(x, y, 0) != 3.0f) continue;
      const glm::dvec3 p =
          eye + glm::dvec3(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
      const double off = direct.at(x, y) - light(p + normal * 0.125);
      worst = std::max(worst, std::abs(off));
      exact += std::abs(off) < 40 * 0x1p-12;  // cells are good to 2^-13
      sum += picked.at(x, y) - light(p);
      ++count;
    }
  }
  std::printf("%d of %d exact, worst %.3f; cells picked by rays: %.4f off on average\n", exact,
              count, worst, sum / count);
  ASSERT_GT(count, 500);
  EXPECT_GT(exact, count / 2);
  // From corner to corner of the coarsest cell the light changes by 3.5 times its size.
  EXPECT_LT(worst, 0.3 * 3.5 * 0.25 * std::exp2(coarsest));
  EXPECT_NEAR(sum / count, 0, 0.05);
}

}  // namespace
}  // namespace kaamos::effects
