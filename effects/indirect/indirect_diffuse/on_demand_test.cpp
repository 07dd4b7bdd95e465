// SPDX-License-Identifier: MIT
// Tests of the volume of which rays bake what they read, and of its filter.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "effects/assets/scene/shapes.h"
#include "effects/indirect/indirect_diffuse/cell_filter.h"
#include "effects/indirect/indirect_diffuse/indirect_fixture.h"
#include "effects/indirect/indirect_diffuse/volume_on_demand.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

std::string backend_name(const testing::TestParamInfo<std::string>& info) {
  return info.param;
}

class VolumesOnDemand : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "vulkan") KAAMOS_NEED_VULKAN();
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, VolumesOnDemand, testing::Values("embree", "vulkan"),
                         backend_name);

Outcome bake(VolumeOnDemand& volume, Stage& stage, const std::vector<std::uint32_t>& reads,
             std::uint32_t& baked) {
  return volume.bake(reads, stage.scene.cameras.front().position(), {}, baked).value();
}

// What was read is baked once, by as many paths as were asked for, and nothing else is.
TEST_P(VolumesOnDemand, HoldWhatWasRead) {
  Stage stage(small_scene(0.3f), 4, 4, GetParam());
  const rtapi::ShaderLibrary library = volume_bake_library().value();
  const BakeScope scope = {stage.device, stage.queue,    stage.frame, stage.gpu,
                           stage.scene,  stage.lighting, library};
  const IndirectVolume layout = layout_volume(stage.scene, 1.0f).value();
  VolumeOnDemand volume = VolumeOnDemand::create(scope, {.samples = 15}, layout).value();
  const std::vector<std::uint32_t> cells = layout.cells_in_use();
  std::vector<std::uint32_t> reads(layout.cells.size());
  for (std::size_t i = 0; i < cells.size(); i += 3) reads[cells[i]] = 1;
  std::uint32_t baked = 0;
  ASSERT_EQ(bake(volume, stage, reads, baked), Outcome::kDone);
  EXPECT_EQ(baked, (cells.size() + 2) / 3);
  EXPECT_EQ(volume.statistics().cells, baked);
  EXPECT_EQ(volume.statistics().paths, 15u * baked);
  const IndirectVolume before = volume.known().value();
  ASSERT_EQ(bake(volume, stage, reads, baked), Outcome::kDone);
  EXPECT_EQ(baked, 0u) << "they hold their light already";
  EXPECT_EQ(volume.known().value().cells[cells[0]].mean, before.cells[cells[0]].mean);
  // A cell that was never read has the light of others.
  EXPECT_EQ(before.cells[cells[1]].validity, 0.0f);
  EXPECT_GT(before.cells[cells[1]].mean.x, 0.0f);
}

// Baked cell by cell, in any order, it is the same volume.
TEST_P(VolumesOnDemand, DoNotDependOnTheOrderOfReads) {
  Stage stage(small_scene(0.3f), 4, 4, GetParam());
  const rtapi::ShaderLibrary library = volume_bake_library().value();
  const BakeScope scope = {stage.device, stage.queue,    stage.frame, stage.gpu,
                           stage.scene,  stage.lighting, library};
  const IndirectVolume layout = layout_volume(stage.scene, 1.0f).value();
  std::vector<IndirectVolume> volumes;
  for (const int parts : {1, 3}) {
    VolumeOnDemand volume = VolumeOnDemand::create(scope, {.samples = 8}, layout).value();
    for (int part = parts - 1; part >= 0; --part) {
      std::vector<std::uint32_t> reads(layout.cells.size());
      for (std::size_t i = 0; i < reads.size(); ++i) {
        reads[i] = i % static_cast<std::size_t>(parts) == static_cast<std::size_t>(part) ? 1 : 0;
      }
      std::uint32_t baked = 0;
      ASSERT_EQ(bake(volume, stage, reads, baked), Outcome::kDone);
    }
    volumes.push_back(volume.known().value());
  }
  for (std::size_t i = 0; i < layout.cells.size(); ++i) {
    ASSERT_EQ(volumes[0].cells[i].mean, volumes[1].cells[i].mean) << i;
    ASSERT_EQ(volumes[0].cells[i].slope_z, volumes[1].cells[i].slope_z) << i;
  }
}

// A board between cells: they do not see each other, and others do.
TEST_P(VolumesOnDemand, SeeNothingThroughWalls) {
  Scene scene = small_scene(0.3f);
  Mesh mesh;
  add_shape(mesh, box({0.02, 8, 8}), 0);
  Instance board;
  board.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  board.transform = translate({0.4, 0, 0});
  scene.meshes.push_back(mesh);
  scene.instances.push_back(board);
  Stage stage(scene, 4, 4, GetParam());
  const rtapi::ShaderLibrary library = volume_bake_library().value();
  const BakeScope scope = {stage.device, stage.queue,    stage.frame, stage.gpu,
                           stage.scene,  stage.lighting, library};
  const std::vector<CellPlace> places = {{{0, 4, 3}, 1.0f}, {{-1, 4, 3}, 1.0f}};
  VolumeBaker baker = VolumeBaker::create(scope, {}, places).value();
  baker.see(stage.scene.cameras.front().position());
  baker.see_around({0, 1}).value();
  const std::vector<std::uint32_t> seen = baker.seen().value();
  EXPECT_EQ(seen[1], (1u << kSeenCells) - 1) << "nothing lies about the second cell";
  for (std::uint32_t i = 0; i < kSeenCells; ++i) {
    EXPECT_EQ(seen[0] >> i & 1, seen_offset(i).x > 0 ? 0u : 1u) << i;
  }
}

// Cells of 8 x 8 x 8 with a light and its noise.
struct NoisyCells {
  IndirectVolume volume;
  std::vector<std::uint32_t> cells, seen, samples;
  std::vector<CellSums> sums;

  // `light` by place along x; each half has `count` samples of a standard deviation of `noise`.
  template <class Light>
  NoisyCells(Light light, double noise, std::uint32_t count) {
    volume.cell = 1.0f;
    volume.bricks = glm::uvec3(1);
    volume.brick_starts = {0};
    volume.cells.resize(kCellsPerBrick);
    cells.resize(kCellsPerBrick);
    std::iota(cells.begin(), cells.end(), 0u);
    seen.assign(cells.size(), (1u << kSeenCells) - 1);
    samples.assign(2 * cells.size(), count);
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, noise);
    for (const std::uint32_t cell : cells) {
      for (int half = 0; half < 2; ++half) {
        CellSums sum;
        for (std::uint32_t i = 0; i < count; ++i) {
          const double sample = light(cell % kBrickCells) + normal(random);
          sum.mean += glm::vec3(static_cast<float>(sample));
          sum.luminance_squared += static_cast<float>(sample * sample);
        }
        sums.push_back(sum);
      }
      volume.cells[cell] = cell_of(&sums[2 * cell], &samples[2 * cell], true);
    }
  }
  void filter() { filter_cells({cells, seen, samples, sums}, volume); }
  // Root mean square of the means.
  template <class Light>
  double error(Light light) const {
    double sum = 0;
    for (const std::uint32_t cell : cells) {
      sum +=
          std::pow(static_cast<double>(volume.cells[cell].mean.x) - light(cell % kBrickCells), 2);
    }
    return std::sqrt(sum / static_cast<double>(cells.size()));
  }
};

// Up to 27 cells of the same light, and at least 8: the error falls to between a fifth and a third.
TEST(CellFilters, TakeOutNoise) {
  const auto light = [](std::uint32_t) { return 5.0; };
  NoisyCells cells(light, 1.0, 8);
  EXPECT_NEAR(cells.error(light), 0.25, 0.03);  // 1 / sqrt(16)
  cells.filter();
  EXPECT_LT(cells.error(light), 0.25 / 3);
}

// The noise is known from the samples: what differs by more is not averaged.
TEST(CellFilters, KeepEdgesThatAreNoNoise) {
  const auto light = [](std::uint32_t x) { return x < 4 ? 1.0 : 5.0; };
  NoisyCells cells(light, 0.5, 64);
  const double before = cells.error(light);
  cells.filter();
  EXPECT_LT(cells.error(light), 1.2 * before);
}

TEST(CellFilters, MixNothingAcrossWalls) {
  const auto light = [](std::uint32_t x) { return x < 4 ? 1.0 : 5.0; };
  NoisyCells cells(light, 1.0, 8);
  for (std::uint32_t i = 0; i < cells.cells.size(); ++i) {
    for (std::uint32_t k = 0; k < kSeenCells; ++k) {
      const int x = static_cast<int>(i % kBrickCells), to = x + seen_offset(k).x;
      if ((x < 4) != (to < 4)) cells.seen[i] &= ~(1u << k);
    }
  }
  cells.filter();
  EXPECT_LT(cells.error(light), 0.25 / 2);
}

// No more light than before, and no less.
TEST(CellFilters, KeepTheEnergyOfRareBrightSamples) {
  const auto light = [](std::uint32_t) { return 1.0; };
  NoisyCells cells(light, 0.0, 8);
  std::mt19937 random(2);
  double before = 0, after = 0;
  for (const std::uint32_t cell : cells.cells) {
    if (random() % 8 != 0) continue;
    cells.sums[2 * cell].mean += glm::vec3(40);
    cells.sums[2 * cell].luminance_squared += 1600;
    cells.volume.cells[cell] = cell_of(&cells.sums[2 * cell], &cells.samples[2 * cell], true);
  }
  for (const VolumeCell& cell : cells.volume.cells) before += static_cast<double>(cell.mean.x);
  cells.filter();
  for (const VolumeCell& cell : cells.volume.cells) after += static_cast<double>(cell.mean.x);
  EXPECT_NEAR(after, before, 0.03 * before);
}

}  // namespace
}  // namespace kaamos::effects
