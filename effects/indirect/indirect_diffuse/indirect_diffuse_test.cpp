// SPDX-License-Identifier: MIT
// Indirect light against known answers, and the failures of a volume that the talk shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <vector>

#include "effects/assets/built_in/mirror_hall.h"
#include "effects/assets/common/file.h"
#include "effects/assets/scene/shapes.h"
#include "effects/indirect/indirect_diffuse/indirect_fixture.h"

namespace kaamos::effects {
namespace {

// Under constant light, the gathered light is exactly the light times the ambient visibility, and
// the light sampled at the surface is the light itself.
TEST(IndirectDiffuse, OfAConstantFieldIsAmbientVisibility) {
  Stage stage(small_scene(0.5f));
  const IndirectVolume volume = constant_volume(stage.scene, 0.5f);
  const FloatImage direct = stage.gather(volume, mode(IndirectMode::kDirect), 1);
  const FloatImage gathered = stage.gather(volume, mode(IndirectMode::kHitBlack, 100), 256);
  const FloatImage position = stage.frame.read(stage.device, stage.queue, kPosition).value();
  const glm::dvec3 eye = stage.scene.cameras.front().position();
  int count = 0;
  for (std::uint32_t y = 0; y < stage.height; ++y) {
    for (std::uint32_t x = 0; x < stage.width; ++x) {
      if (stage.ids.at(x, y, 0) == 0) continue;
      ASSERT_NEAR(direct.at(x, y), 0.5, 1e-5);
      if (stage.ids.at(x, y, 0) != 1.0f) continue;
      const double r = std::hypot(eye.x + position.at(x, y, 0), eye.z + position.at(x, y, 2));
      const double open = 1 - sphere_occlusion(1.0, 1.5, r);
      ASSERT_NEAR(gathered.at(x, y), 0.5 * open, 0.5 * 0.03) << x << "," << y;
      ++count;
    }
  }
  EXPECT_GT(count, 50);
}

// A ray reads a single cell, but on average that equals all eight: linear for linear light. A shift
// of half a cell along any axis would show as 0.125 or more; the mean of a pixel's 1024 rays is
// good to 0.02.
TEST(IndirectDiffuse, CellsThatRaysChooseAverageToAllEight) {
  Scene scene = small_scene(0.0f);
  scene.instances.resize(1);  // the plane
  Stage stage(scene);
  IndirectVolume volume = constant_volume(stage.scene, 0);
  const std::vector<glm::dvec3> centers = volume.cell_centers();
  const glm::dvec3 gradient = {0.5, 2, 1};
  const auto light = [&](const glm::dvec3& p) { return 20 + glm::dot(gradient, p); };
  for (std::size_t i = 0; i < centers.size(); ++i) {
    volume.cells[i].mean = glm::vec3(static_cast<float>(light(centers[i])));
  }
  constexpr float kLength = 0.75f;
  const FloatImage gathered = stage.gather(volume, mode(IndirectMode::kHitBlack, kLength), 1024);
  const FloatImage position = stage.frame.read(stage.device, stage.queue, kPosition).value();
  const glm::dvec3 eye = stage.scene.cameras.front().position();
  double sum = 0;
  int count = 0;
  for (std::uint32_t y = 0; y < stage.height; ++y) {
    for (std::uint32_t x = 0; x < stage.width; ++x) {
      const glm::dvec3 p =
          eye + glm::dvec3(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
      // Further out, rays end outside of the volume.
      if (stage.ids.at(x, y, 0) == 0 || std::max(std::abs(p.x), std::abs(p.z)) > 5) continue;
      // On average a ray ends 2/3 of its length above the plane.
      const double expected = light(p + glm::dvec3(0, kLength * 2 / 3, 0));
      ASSERT_NEAR(gathered.at(x, y), expected, 0.1) << x << "," << y;
      sum += gathered.at(x, y) - expected;
      ++count;
    }
  }
  ASSERT_GT(count, 50);
  EXPECT_NEAR(sum / count, 0, 0.01);
}

// If the chosen cell lies in a solid, the other ones of the eight replace it, as they do without a
// choice.
TEST(IndirectDiffuse, CellsInSolidsAreStoodInForByOthers) {
  Scene scene = small_scene(0.0f);
  scene.instances.resize(1);
  Stage stage(scene);
  IndirectVolume volume = constant_volume(stage.scene, 0.5f);
  for (std::size_t i = 0; i < volume.cells.size(); ++i) {
    // Every second cell along each axis.
    if (((i + i / kBrickCells + i / (kBrickCells * kBrickCells)) & 1) != 0) volume.cells[i] = {};
  }
  const FloatImage gathered = stage.gather(volume, mode(IndirectMode::kHitBlack, 1.0f), 64);
  const FloatImage position = stage.frame.read(stage.device, stage.queue, kPosition).value();
  const glm::dvec3 eye = stage.scene.cameras.front().position();
  int count = 0;
  for (std::uint32_t y = 0; y < stage.height; ++y) {
    for (std::uint32_t x = 0; x < stage.width; ++x) {
      const double far =
          std::max(std::abs(eye.x + position.at(x, y, 0)), std::abs(eye.z + position.at(x, y, 2)));
      if (stage.ids.at(x, y, 0) == 0 || far > 5) continue;
      ASSERT_NEAR(gathered.at(x, y), 0.5, 1e-4) << x << "," << y;
      ++count;
    }
  }
  EXPECT_GT(count, 50);
}

// Integrates f over 0..1 by the midpoint rule.
template <class F>
double integral(const F& f) {
  constexpr int kSteps = 10000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += f((i + 0.5) / kSteps);
  return sum / kSteps;
}

// Radiance from directions whose cosine with the slope is `cosine`, for a mean of 1: a power of the
// shifted cosine.
double lobe(double cosine, double power) {
  return (power + 1) * std::pow(0.5 + 0.5 * cosine, power);
}

// A slope steeper than the mean is read as a lobe with the same mean and slope, where a linear
// function cut off at 0 would have more light.
TEST(IndirectDiffuse, SteepSlopesAreLobesOfTheSameMean) {
  Scene scene = small_scene(1.0f);
  scene.instances.resize(1);  // the plane
  Stage stage(scene);
  for (const double slope : {1.5, -1.5, 1.8}) {
    IndirectVolume volume = constant_volume(stage.scene, 1.0f);
    for (VolumeCell& cell : volume.cells) cell.slope_y = glm::vec3(static_cast<float>(slope));
    const double steep = std::abs(slope);
    const double power = 2 * steep / (3 - steep);
    const auto over_sphere = [&](double shifted) { return lobe(2 * shifted - 1, power); };
    ASSERT_NEAR(integral(over_sphere), 1, 1e-6);
    ASSERT_NEAR(3 * integral([&](double t) { return (2 * t - 1) * over_sphere(t); }), steep, 1e-6);
    const double sign = slope > 0 ? 1 : -1;
    const double expected = 2 * integral([&](double c) { return c * lobe(sign * c, power); });
    const FloatImage gathered = stage.gather(volume, mode(IndirectMode::kHitBlack, 0.1f), 256);
    EXPECT_NEAR(mean_of(gathered, stage.ids), expected, 0.01 * expected) << slope;
  }
}

// A plane of albedo a under a sky of 1: the radiance is 1 from above and a from below.
TEST(IndirectVolumes, HoldWhatArrivesOverAPlane) {
  Scene scene = small_scene(1.0f);
  for (Vertex& vertex : scene.meshes[0].vertices) {
    vertex.position = glm::clamp(vertex.position, glm::vec3(-3), glm::vec3(3));
  }
  scene.instances.resize(1);
  for (Material& material : scene.materials) {
    material.constants.base_color = glm::vec4(0.4f, 0.4f, 0.4f, 1);
    material.constants.metallic = 0;
    material.constants.specular = 0;
  }
  Stage stage(scene);
  const IndirectVolume volume = stage.bake(0.25f, 1024);
  const std::vector<glm::dvec3> centers = volume.cell_centers();
  int count = 0;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    // Close above the middle of the plane, which fills the lower half there.
    if (std::hypot(centers[i].x, centers[i].z) > 0.4 || centers[i].y < 0 || centers[i].y > 0.15) {
      continue;
    }
    EXPECT_NEAR(volume.cells[i].mean.x, 0.7, 0.015);
    EXPECT_NEAR(volume.cells[i].slope_y.x, 0.75 * 0.6, 0.03);
    EXPECT_NEAR(volume.cells[i].slope_x.x, 0, 0.03);
    EXPECT_EQ(volume.cells[i].validity, 1.0f);
    ++count;
  }
  EXPECT_GT(count, 3);
}

// Two rooms with a thin wall between them, one open to the sky, one closed.
Scene cells_scene(float thickness) {
  Scene scene = small_scene(1.0f);
  scene.meshes.clear();
  scene.instances.clear();
  const auto add_box = [&](const glm::dvec3& low, const glm::dvec3& high) {
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    Mesh mesh;
    const Shape shape = box((high - low) * 0.5);
    mesh.add_geometry(shape.vertices, shape.indices, 0, false);
    scene.meshes.push_back(mesh);
    instance.transform[3] = glm::dvec4((low + high) * 0.5, 1);
    scene.instances.push_back(instance);
  };
  const double t = thickness;
  add_box({-2 - t, -t, -2 - t}, {2 + t, 0, 2 + t});  // floor
  add_box({0, 2, -2 - t}, {2 + t, 2 + t, 2 + t});    // roof of the closed room
  add_box({-t / 2, 0, -2}, {t / 2, 2, 2});           // the wall between
  add_box({2, 0, -2}, {2 + t, 2, 2});
  add_box({-2 - t, 0, -2 - t}, {2 + t, 2, -2});
  add_box({-2 - t, 0, 2}, {2 + t, 2, 2 + t});
  scene.materials.resize(1);
  scene.materials[0].constants = {};
  scene.materials[0].constants.base_color = glm::vec4(0.7f, 0.7f, 0.7f, 1);
  Camera& camera = scene.cameras.front();
  camera.camera_to_world = look_at({1.5, 1.2, 0.3}, {0.0, 0.5, -0.3});
  camera.vertical_fov = 1.2;
  return scene;
}

// Light leaks through a wall of 5 mm into a room that should be dark: sampled at the surface, and
// by rays. [Northlight deck: Issues with Direct Sampling of GI Data]
TEST(IndirectDiffuse, RaysStopTheLeakThroughThinWalls) {
  Stage stage(cells_scene(0.005f));
  const IndirectVolume volume = stage.bake(0.25f, 64);
  const double direct = mean_of(stage.gather(volume, mode(IndirectMode::kDirect), 1), stage.ids);
  const double gathered =
      mean_of(stage.gather(volume, mode(IndirectMode::kHitBlack, 4), 64), stage.ids);
  RecordProperty("direct", std::to_string(direct));
  RecordProperty("gathered", std::to_string(gathered));
  EXPECT_GT(direct, 0.01);
  EXPECT_LT(gathered, direct / 4) << direct << " " << gathered;
}

// Black hits lose the light that the walls reflect; shading them brings it back. [Northlight deck:
// Diffuse Lighting on Hit Shader]
TEST(IndirectDiffuse, NearFieldLightingMendsBlackHits) {
  Scene scene = cells_scene(0.3f);
  scene.cameras.front().camera_to_world = look_at({-1.0, 1.9, 1.5}, {-0.6, 0.0, -0.6});
  Stage stage(scene);
  const IndirectVolume volume = stage.bake(0.25f, 256);
  const double black = mean_of(stage.gather(volume, mode(IndirectMode::kHitBlack), 64), stage.ids);
  const double near_field =
      mean_of(stage.gather(volume, mode(IndirectMode::kNearField), 64), stage.ids);
  const double direct = mean_of(stage.gather(volume, mode(IndirectMode::kDirect), 1), stage.ids);
  EXPECT_LT(black, 0.85 * near_field);
  EXPECT_NEAR(near_field / direct, 1, 0.25);  // each is all of the light
}

// The shape of a lamp adds no light: the volume is the same, bit for bit, as without the shape.
TEST(IndirectVolumes, ALampThatShowsItsShapeCountsOnce) {
  Scene bare = make_mirror_hall();
  const auto is_bulb = [](const Instance& i) { return i.mask == kMaskEmissiveProxy; };
  ASSERT_EQ(std::erase_if(bare.instances, is_bulb), 1u);
  Stage with(make_mirror_hall()), without(bare);
  const IndirectVolume a = with.bake(0.5f, 16), b = without.bake(0.5f, 16);
  ASSERT_GT(a.cells.size(), 1000u);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    ASSERT_EQ(a.cells[i].mean, b.cells[i].mean) << i;
    sum += a.cells[i].mean.x;
  }
  EXPECT_GT(sum, 1.0);
  // Gathering rays do not see the shape either; only the camera does.
  const FloatImage seen = with.gather(a, mode(IndirectMode::kNearField), 4);
  const FloatImage expected = without.gather(b, mode(IndirectMode::kNearField), 4);
  std::size_t different = 0;
  for (std::size_t i = 0; i < seen.values.size(); ++i) {
    different += seen.values[i] == expected.values[i] ? 0 : 1;
  }
  EXPECT_LE(different, 4u);  // the pixels that show the lamp
}

TEST(IndirectVolumes, FilesComeBack) {
  Stage stage(small_scene(1.0f));
  const IndirectVolume volume = stage.bake(0.5f, 4);
  const std::string path =
      (std::filesystem::temp_directory_path() / "kaamos_volume_test.gi").string();
  ASSERT_TRUE(save_volume(path, volume).ok());
  const IndirectVolume loaded = load_volume(path).value();
  EXPECT_EQ(loaded.brick_starts, volume.brick_starts);
  ASSERT_EQ(loaded.cells.size(), volume.cells.size());
  EXPECT_EQ(std::memcmp(loaded.cells.data(), volume.cells.data(),
                        volume.cells.size() * sizeof(VolumeCell)),
            0);
  std::vector<std::uint8_t> bytes = read_file(path).value();
  // Version 2 had darker light: it is refused by name.
  std::vector<std::uint8_t> old = bytes;
  old[8] = 2;
  ASSERT_TRUE(write_file(path, old).ok());
  EXPECT_NE(load_volume(path).error().message.find("version is 2, this program reads 3"),
            std::string::npos);
  // Damage is found wherever it is.
  for (const std::size_t at : {std::size_t{0}, std::size_t{9}, std::size_t{56}, bytes.size() / 2}) {
    std::vector<std::uint8_t> damaged = bytes;
    damaged[at] ^= 0x55;
    ASSERT_TRUE(write_file(path, damaged).ok());
    EXPECT_FALSE(load_volume(path).ok()) << at;
  }
  bytes.resize(bytes.size() - 1);
  ASSERT_TRUE(write_file(path, bytes).ok());
  EXPECT_NE(load_volume(path).error().message.find("bake it again"), std::string::npos);
  std::filesystem::remove(path);
  EXPECT_FALSE(load_volume(path).ok());
}

TEST(IndirectVolumes, TooManyCellsAreAnError) {
  EXPECT_NE(layout_volume(small_scene(1.0f), 0.001f).error().message.find("larger cells"),
            std::string::npos);
}

TEST(IndirectVolumes, LargeScenesGetLargerCells) {
  const Scene scene = small_scene(1.0f);
  const auto cells = [&](float cell) { return layout_volume(scene, cell).value().cells.size(); };
  EXPECT_EQ(layout_volume(scene).value().cell, kVolumeCell);
  EXPECT_EQ(layout_volume(scene, {}, cells(kVolumeCell)).value().cell, kVolumeCell);
  ASSERT_GT(cells(kVolumeCell), cells(1.0f));
  const IndirectVolume larger = layout_volume(scene, {}, cells(1.0f)).value();
  EXPECT_GT(larger.cell, kVolumeCell);
  EXPECT_EQ(larger.cells.size(), cells(larger.cell));
  EXPECT_LE(larger.cells.size(), cells(1.0f));
  EXPECT_GT(cells(larger.cell / 2), cells(1.0f));
}

}  // namespace
}  // namespace kaamos::effects
