// SPDX-License-Identifier: MIT
// Tests what goes wrong with light from a volume of coarse cells, a number for each failure, and
// how much rays help. [GDC 2018 talk; Northlight deck: Issues with Direct Sampling of GI Data]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "effects/assets/built_in/leak_scenes.h"
#include "effects/assets/scene/shapes.h"
#include "effects/indirect/indirect_diffuse/indirect_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

// Light from one volume in each of the four modes: means over the picture.
struct Leak {
  double direct, times_ao, hit_black, near_field;
};

Leak leak_of(Stage& stage, const IndirectVolume& volume) {
  constexpr std::uint32_t kRays = 64;
  const FloatImage direct = stage.gather(volume, mode(IndirectMode::kDirect), 1);
  return {mean_of(direct, stage.ids),
          mean_of(stage.gather(volume, mode(IndirectMode::kTimesOpen), kRays), stage.ids),
          mean_of(stage.gather(volume, mode(IndirectMode::kHitBlack), kRays), stage.ids),
          mean_of(stage.gather(volume, mode(IndirectMode::kNearField), kRays), stage.ids)};
}

void say(const std::string& what, const Leak& leak) {
  std::printf("%s: direct %.5f, x AO %.5f, hit = black %.5f, near-field %.5f\n", what.c_str(),
              leak.direct, leak.times_ao, leak.hit_black, leak.near_field);
}

// --- Light through thin walls

// One room of nine is lit. Cells in the middle of a dark room are dark, but cells at a wall thinner
// than they are lie half in the lit room.
Leak sealed_leak(double thickness, float cell, int& dark_cells) {
  Stage stage(make_sealed_cells({.thickness = thickness}), 16, 12);
  const IndirectVolume volume = stage.bake(cell, 32);
  const std::vector<glm::dvec3> centers = volume.cell_centers();
  const double pitch = kSealedRoomSize + thickness;
  dark_cells = 0;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const glm::dvec3 from_middle = glm::abs(centers[i] - glm::dvec3(0, 1, pitch));
    if (std::max({from_middle.x, from_middle.y, from_middle.z}) > 0.99) continue;
    EXPECT_EQ(volume.cells[i].mean, glm::vec3(0));
    ++dark_cells;
  }
  const Leak leak = leak_of(stage, volume);
  say("walls of " + std::to_string(thickness) + " m, cells of " + std::to_string(cell) + " m",
      leak);
  return leak;
}

TEST(VolumeFailures, SealedRoomsLeakThroughThinWalls) {
  int dark_cells = 0;
  const Leak thin = sealed_leak(0.005, 0.25f, dark_cells);
  EXPECT_GT(dark_cells, 200);
  EXPECT_GT(thin.direct, 0.01);
  EXPECT_LT(thin.hit_black, thin.direct / 4);
  EXPECT_LT(sealed_leak(0.3, 0.25f, dark_cells).direct, thin.direct / 10);
}

TEST(VolumeFailures, CellsCoarserThanAWallLeak) {
  int dark_cells = 0;
  const Leak coarse = sealed_leak(0.3, 1.0f, dark_cells);
  EXPECT_GT(coarse.direct, 0.01);
  EXPECT_LT(coarse.hit_black, coarse.direct / 4);
}

// --- Steps on round things

constexpr double kDomeScale = 0.5;  // with cells of 25 cm, like the full dome with 50 cm

Scene small_dome(bool sealed) {
  Scene scene = make_thin_dome({.thickness = 0.005, .sealed = sealed});
  for (Instance& instance : scene.instances) {
    instance.transform = glm::dmat4(glm::dmat3(kDomeScale)) * instance.transform;
  }
  Camera& camera = scene.cameras.front();
  camera.camera_to_world =
      look_at(kDomeScale * glm::dvec3(0, 1.6, 0), kDomeScale * glm::dvec3(0, 3.4, -3.0));
  return scene;
}

// Change from row to row that is faster than `window` rows, relative to the mean: root mean square
// over the picture's columns.
double banding(const FloatImage& image, std::uint32_t window) {
  double sum = 0, mean = 0;
  std::size_t count = 0;
  for (std::uint32_t x = 0; x < image.width; ++x) {
    for (std::uint32_t y = window; y + window < image.height; ++y) {
      double around = 0;
      for (std::uint32_t i = y - window; i <= y + window; ++i) around += image.at(x, i);
      const double high = image.at(x, y) - around / (2 * window + 1);
      sum += high * high;
      mean += image.at(x, y);
      ++count;
    }
  }
  return std::sqrt(sum / count) / (mean / count);
}

TEST(VolumeFailures, TheDomeShowsTheCellsSteps) {
  constexpr std::uint32_t kRows = 12;
  Stage stage(small_dome(false), 3, 96);
  const IndirectVolume volume = stage.bake(0.25f, 64);
  const double direct = banding(stage.gather(volume, mode(IndirectMode::kDirect), 1), kRows);
  const double black =
      banding(stage.gather(volume, mode(IndirectMode::kHitBlack, 1.5f), 2048), kRows);
  const double near_field =
      banding(stage.gather(volume, mode(IndirectMode::kNearField, 1.5f), 2048), kRows);
  std::printf("banding of the dome: direct %.4f, hit = black %.4f, near-field %.4f\n", direct,
              black, near_field);
  EXPECT_LT(black, direct / 5);
  EXPECT_LT(near_field, direct / 5);
}

TEST(VolumeFailures, ASealedDomeIsDark) {
  Stage stage(small_dome(true), 16, 12);
  const IndirectVolume volume = stage.bake(0.25f, 64);
  const Leak leak = leak_of(stage, volume);
  say("sealed dome", leak);
  EXPECT_GT(leak.direct, 0.01);
  EXPECT_LT(leak.hit_black, leak.direct / 4);
}

// --- Things that were not there when the volume was baked

Scene room(bool with_table) {
  Scene scene = small_scene(1.0f);
  scene.meshes.clear();
  scene.instances.clear();
  const auto add = [&](const glm::dvec3& low, const glm::dvec3& high) {
    Mesh mesh;
    add_shape(mesh, box((high - low) * 0.5), 0);
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    instance.transform = translate((low + high) * 0.5);
    scene.meshes.push_back(mesh);
    scene.instances.push_back(instance);
  };
  add({-2.3, -0.3, -2.3}, {2.3, 0, 2.3});
  add({-2.3, 0, -2.3}, {-2, 2, 2.3});
  add({-2, 0, -2.3}, {2.3, 2, -2});
  if (with_table) add({-0.6, 0.25, -0.6}, {0.6, 0.3, 0.6});
  scene.materials.resize(1);
  scene.materials[0].constants = {};
  scene.materials[0].constants.base_color = glm::vec4(0.7f, 0.7f, 0.7f, 1);
  Camera& camera = scene.cameras.front();
  camera.camera_to_world = look_at({0.3, 0.5, 1.9}, {0, 0, 0});
  camera.vertical_fov = 0.5;
  return scene;
}

// Root mean square difference over the pixels that show an instance.
double error_on(const FloatImage& image, const FloatImage& truth, const FloatImage& ids,
                float instance) {
  double sum = 0, count = 0;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      if (ids.at(x, y, 0) != instance) continue;
      sum += std::pow(static_cast<double>(image.at(x, y)) - truth.at(x, y), 2);
      ++count;
    }
  }
  EXPECT_GT(count, 30);
  return std::sqrt(sum / count);
}

// The floor under a table that the volume does not know, compared with rays that end at the first
// hit in a volume that does.
TEST(VolumeFailures, DynamicObjectsNeedRays) {
  Stage baked(room(false));
  const IndirectVolume volume = baked.bake(0.25f, 2048);
  Stage stage(room(true));
  const FloatImage truth =
      stage.gather(stage.bake(0.25f, 2048), mode(IndirectMode::kNearField, 1e3f), 1024);
  const FloatImage direct = stage.gather(volume, mode(IndirectMode::kDirect), 1);
  const FloatImage screen = stage.occluded_on_screen(volume, {accurate_gtao(4, 16), 3});
  const FloatImage occluded = stage.gather(volume, mode(IndirectMode::kTimesOpen), 256);
  const FloatImage black = stage.gather(volume, mode(IndirectMode::kHitBlack), 256);
  const FloatImage near_field = stage.gather(volume, mode(IndirectMode::kNearField), 256);
  std::vector<double> errors;
  const FloatImage* const images[] = {&direct, &screen, &occluded, &black, &near_field};
  for (const FloatImage* image : images) {
    errors.push_back(error_on(*image, truth, stage.ids, 1.0f));
  }
  std::printf(
      "under a table: direct %.4f, x screen AO %.4f, x AO %.4f, hit = black %.4f, "
      "near-field %.4f\n",
      errors[0], errors[1], errors[2], errors[3], errors[4]);
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], 0.95 * errors[i - 1]) << i;
}

// --- What is right

// Light gathered in a constant field is the field times the ambient visibility, apart from noise:
// the two use different random numbers.
TEST(VolumeFailures, AConstantFieldHasNone) {
  constexpr std::uint32_t kRays = 256;
  constexpr float kRadius = 3;
  Stage stage(small_scene(0.5f));
  const IndirectVolume volume = constant_volume(stage.scene, 0.5f);
  const FloatImage gathered = stage.gather(volume, mode(IndirectMode::kHitBlack, kRadius), kRays);
  const FloatImage open = stage.ambient(kRadius, kRays);
  double sum = 0, variance = 0;
  int count = 0, far = 0;
  for (std::size_t i = 0; i < open.values.size(); ++i) {
    if (stage.ids.values[i * stage.ids.channels] == 0) continue;
    const double p = open.values[i];
    const double difference = gathered.values[4 * i] / 0.5 - p;
    // The variance of the difference of two means of independent rays. These rays are more evenly
    // spread.
    const double of_pixel = 2 * std::max(p * (1 - p), 1.0 / kRays) / kRays;
    far += difference * difference > 4 * of_pixel;
    sum += difference;
    variance += of_pixel;
    ++count;
  }
  ASSERT_GT(count, 50);
  EXPECT_LT(std::abs(sum), 2 * std::sqrt(variance)) << count << " pixels";
  EXPECT_LE(far, count / 20);
  // By the same rays the light is the same; the fourth channel is a distance.
  const FloatImage times = stage.gather(volume, mode(IndirectMode::kTimesOpen, kRadius), kRays);
  for (std::size_t i = 0; i < times.values.size(); ++i) {
    if (i % 4 == 3) continue;
    ASSERT_NEAR(times.values[i], gathered.values[i], 1e-5);
  }
}

// Occlusion that reaches nowhere leaves the volume as it is, and one that does takes light away.
TEST(VolumeFailures, ScreenOcclusionOnlyDarkens) {
  for (const std::string backend : {"embree", "vulkan"}) {
    if (backend == "vulkan") KAAMOS_NEED_VULKAN();
    Stage stage(small_scene(0.5f), 24, 16, backend);
    const IndirectVolume volume = constant_volume(stage.scene, 0.5f);
    const FloatImage direct = stage.gather(volume, mode(IndirectMode::kDirect), 1);
    const FloatImage none = stage.occluded_on_screen(volume, {{}, 0});
    const FloatImage some = stage.occluded_on_screen(volume, {{}, 3});
    int darker = 0;
    for (std::size_t i = 0; i < none.values.size(); ++i) {
      ASSERT_NEAR(none.values[i], direct.values[i], 1e-6) << backend;
      ASSERT_LE(some.values[i], direct.values[i] + 1e-6) << backend;
      darker += some.values[i] < 0.9f * direct.values[i];
    }
    EXPECT_GT(darker, 30) << backend;
  }
}

// --- Where rays end

// A floor under a ceiling, both of albedo 0.5, in a volume of light 1. A ray that hits the ceiling
// returns 0.5, and one that ends before it 1; hits in a ray's last fifth fade from one to the
// other.
double brought_back(double distance, double length, bool fades) {
  constexpr int kSteps = 4000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine_squared = (i + 0.5) / kSteps;  // uniform for cosine-weighted directions
    const double t = distance / std::sqrt(cosine_squared);
    const double at = std::clamp((t / length - 0.8) / 0.2, 0.0, 1.0);
    const double far = t >= length ? 1 : fades ? at * at * (3 - 2 * at) : 0;
    sum += 0.5 + 0.5 * far;
  }
  return sum / kSteps;
}

TEST(VolumeFailures, NoShellWhereRaysEnd) {
  for (const double distance : {0.5, 0.85, 0.95, 1.05}) {
    Scene scene = small_scene(1.0f);
    scene.meshes.clear();
    scene.instances.clear();
    scene.materials.resize(1);
    scene.materials[0].constants = {};
    scene.materials[0].constants.base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1);
    for (const double height : {0.0, distance}) {
      Mesh mesh;
      const double side = height > 0 ? -10 : 10;
      add_shape(mesh, patch({-10, height, side}, {20, 0, 0}, {0, 0, -2 * side}, 1, 1), 0);
      Instance instance;
      instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
      scene.meshes.push_back(mesh);
      scene.instances.push_back(instance);
    }
    scene.cameras.front().camera_to_world = look_at({0, 0.4, 0}, {0, 0, -0.2});
    Stage stage(scene, 8, 8);
    const IndirectVolume volume = constant_volume(scene, 1.0f);
    const double found =
        mean_of(stage.gather(volume, mode(IndirectMode::kNearField, 1.0f), 512), stage.ids);
    EXPECT_NEAR(found, brought_back(distance, 1, true), 0.01) << distance;
    if (distance > 0.9 && distance < 1) {
      EXPECT_LT(brought_back(distance, 1, false), found - 0.02) << "the fade shows";
    }
  }
}

// --- Light from one side

// A mean and a slope cannot represent a narrow beam: they would be negative in the directions away
// from it.
TEST(VolumeFailures, NarrowLightRings) {
  Scene scene = small_scene(0.0f);
  Light lamp;
  lamp.type = LightType::kSpot;
  lamp.position = {0, 5, 0};
  lamp.direction = glm::vec3(0, -1, 0);
  lamp.outer_cone_angle = 0.05f;
  lamp.intensity = 1e4f;
  scene.lights.push_back(lamp);
  scene.instances.resize(1);  // the plane
  Stage stage(scene);
  const IndirectVolume volume = stage.bake(0.5f, 256);
  int negative = 0, all = 0;
  double least = 0, brightest = 0;
  for (const VolumeCell& cell : volume.cells) {
    for (int i = 0; i < 6; ++i) {
      const float slope = i < 2 ? cell.slope_x.x : i < 4 ? cell.slope_y.x : cell.slope_z.x;
      const double radiance = cell.mean.x + (i % 2 == 0 ? slope : -slope);
      negative += radiance < 0;
      least = std::min(least, radiance);
      brightest = std::max(brightest, radiance);
      ++all;
    }
  }
  std::printf("ringing: %d of %d negative, %.4f to %.4f\n", negative, all, least, brightest);
  EXPECT_GT(negative, 100);
  EXPECT_LT(least, -0.1 * brightest);
  // Shaders read such a cell as a lobe that is nowhere negative.
  for (const IndirectMode way : {IndirectMode::kDirect, IndirectMode::kHitBlack}) {
    const FloatImage image = stage.gather(volume, mode(way), 64);
    for (const float value : image.values) ASSERT_GE(value, 0.0f);
  }
}

}  // namespace
}  // namespace kaamos::effects
