// SPDX-License-Identifier: MIT
// Sums that are saved, gone on with, refused, and put together from parts.
#include "effects/reference/path_sums.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "effects/assets/common/file.h"
#include "effects/reference/path_fixture.h"

namespace kaamos::effects {
namespace {

Scene small_scene() {
  Scene scene = plane_scene({0.5f, 0.6f, 0.7f}, 0, 0.4f, 30, {0.5f, 0.6f, 0.8f});
  scene.cameras.front().vertical_fov = 0.8;
  const std::uint32_t other = add_material(scene, {0.8f, 0.3f, 0.2f}, 1, 0.3f);
  add_thing(scene, "box", box({0.5, 0.5, 0.5}), other, {0, 0.5, 0});
  Light lamp;
  lamp.position = {1, 2, 1};
  scene.lights.push_back(lamp);
  return scene;
}

PathReferenceDesc small_desc() {
  PathReferenceDesc desc;
  desc.width = 20;
  desc.height = 14;
  desc.each_lamp = true;
  return desc;
}

void expect_equal(const PathSums& a, const PathSums& b) {
  ASSERT_EQ(a.layers.size(), b.layers.size());
  for (std::size_t i = 0; i < a.layers.size(); ++i) {
    EXPECT_EQ(a.layers[i].sums, b.layers[i].sums) << a.layers[i].name;
  }
  EXPECT_EQ(a.samples, b.samples);
}

class PathSumsFile : public testing::Test {
 protected:
  PathSumsFile()
      : path_((std::filesystem::temp_directory_path() /
               ("kaamos-sums-" + std::to_string(getpid()) + ".sums"))
                  .string()) {}
  ~PathSumsFile() override { std::filesystem::remove(path_); }
  const std::string path_;
};

TEST(PathReferences, DoNotDependOnThreads) {
  const Scene scene = small_scene();
  const auto one = trace_reference(scene, small_desc(), 32, "embree", 1);
  const auto three = trace_reference(scene, small_desc(), 32, "embree", 3);
  expect_equal(one->sums(), three->sums());
}

TEST(PathReferences, PartsAddUpToTheWhole) {
  const Scene scene = small_scene();
  const auto whole = trace_reference(scene, small_desc(), 32);
  PathSums sum;
  for (std::uint32_t part = 0; part < 3; ++part) {
    PathReferenceDesc desc = small_desc();
    desc.part = part;
    desc.parts = 3;
    const auto reference = trace_reference(scene, desc, 32);
    if (part == 0) {
      sum = reference->sums();
      continue;
    }
    for (std::size_t i = 0; i < sum.layers.size(); ++i) {
      for (std::uint32_t half = 0; half < kPathHalves; ++half) {
        const auto& add = reference->sums().layers[i].sums[half];
        auto& to = sum.layers[i].sums[half];
        for (std::size_t k = 0; k < to.size(); ++k) to[k] += add[k];
      }
    }
  }
  expect_equal(whole->sums(), sum);
}

TEST_F(PathSumsFile, GoOnWhereTheyWereStopped) {
  const Scene scene = small_scene();
  const auto whole = trace_reference(scene, small_desc(), 64);
  const auto begun = trace_reference(scene, small_desc(), 32);
  save_path_sums(path_, begun->sums()).value();
  auto resumed = trace_reference(scene, small_desc(), 0);
  load_path_sums(path_, resumed->sums()).value();
  EXPECT_EQ(resumed->samples(), 32u);
  EXPECT_EQ(resumed->accumulate(64, {}).value(), Outcome::kDone);
  expect_equal(whole->sums(), resumed->sums());
}

TEST_F(PathSumsFile, StoppedBatchesAreNotCounted) {
  const Scene scene = small_scene();
  auto reference = trace_reference(scene, small_desc(), 0);
  int steps = 0;
  EXPECT_EQ(reference->accumulate(64, [&](double) { return ++steps < 7; }).value(),
            Outcome::kStopped);
  EXPECT_EQ(reference->samples() % 16, 0u);
  EXPECT_EQ(reference->accumulate(64, {}).value(), Outcome::kDone);
  expect_equal(trace_reference(scene, small_desc(), 64)->sums(), reference->sums());
}

TEST_F(PathSumsFile, RefusesWhatDoesNotFit) {
  const Scene scene = small_scene();
  const auto begun = trace_reference(scene, small_desc(), 32);
  save_path_sums(path_, begun->sums()).value();
  const auto refusal = [&](const Scene& other, const PathReferenceDesc& desc) {
    auto reference = trace_reference(other, desc, 0);
    const auto loaded = load_path_sums(path_, reference->sums());
    return loaded ? std::string() : loaded.error().message;
  };
  EXPECT_EQ(refusal(scene, small_desc()), "");
  PathReferenceDesc desc = small_desc();
  desc.width = 21;
  EXPECT_NE(refusal(scene, desc).find("KA3048"), std::string::npos);
  EXPECT_NE(refusal(scene, desc).find("20x14, not of 21x14"), std::string::npos);
  desc = small_desc();
  desc.seed = 7;
  EXPECT_NE(refusal(scene, desc).find("its seed is 0, not 7"), std::string::npos);
  Scene other = scene;
  other.instances.back().transform = translate({0.1, 0.5, 0});
  EXPECT_NE(refusal(other, small_desc()).find("another scene"), std::string::npos);
  other = scene;
  other.materials.front().constants.roughness = 0.41f;
  EXPECT_NE(refusal(other, small_desc()).find("another scene"), std::string::npos);
  std::vector<std::uint8_t> bytes = read_file(path_).value();
  bytes[200] ^= 1;
  write_file(path_, bytes).value();
  EXPECT_NE(refusal(scene, small_desc()).find("damaged"), std::string::npos);
  bytes.resize(100);
  write_file(path_, bytes).value();
  EXPECT_NE(refusal(scene, small_desc()).find("100 bytes"), std::string::npos);
}

TEST(PathReferences, LayersAddUpToTheRadiance) {
  const Scene scene = small_scene();
  const auto reference = trace_reference(scene, small_desc(), 64);
  const double parts = mean_of(*reference, "emission") + mean_of(*reference, "sun") +
                       mean_of(*reference, "lamps") + mean_of(*reference, "indirect") +
                       mean_of(*reference, "reflection");
  EXPECT_NEAR(mean_of(*reference, "radiance"), parts, 1e-5 * parts);
  EXPECT_NEAR(mean_of(*reference, "lamps"), mean_of(*reference, "lamp0"), 0.02);
}

// Halves that had the same seed would tell no error.
TEST(PathReferences, HalvesTellTheError) {
  const Scene scene = small_scene();
  PathReferenceDesc desc = small_desc();
  const auto truth = trace_reference(scene, desc, 4096);
  desc.seed = 5;
  const auto reference = trace_reference(scene, desc, 64);
  const PathSums::Layer& layer = *reference->sums().find("radiance");
  const FloatImage mean = reference->sums().mean(layer);
  const FloatImage expected = truth->sums().mean(*truth->sums().find("radiance"));
  double sum = 0;
  for (std::size_t i = 0; i < mean.values.size(); ++i) {
    sum += std::pow(mean.values[i] - expected.values[i], 2);
  }
  const double actual = std::sqrt(sum / static_cast<double>(mean.values.size()));
  EXPECT_NEAR(reference->sums().error(layer), actual, 0.35 * actual);
}

}  // namespace
}  // namespace kaamos::effects
