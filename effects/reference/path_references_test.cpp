// SPDX-License-Identifier: MIT
// The references in tests/numerics/path_traced are those of today's scenes and of today's paths.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "effects/assets/built_in/built_in.h"
#include "effects/assets/image/exr.h"
#include "effects/reference/path_fixture.h"

namespace kaamos::effects {
namespace {

std::vector<std::string> reference_files() {
  std::vector<std::string> out;
  const std::filesystem::path folder =
      std::filesystem::path(KAAMOS_SOURCE_DIR) / "tests" / "numerics" / "path_traced";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".exr") out.push_back(entry.path().string());
  }
  return out;
}

double mean_of_layer(const FloatImage& image) {
  double sum = 0;
  for (const float value : image.values) sum += value;
  return sum / static_cast<double>(image.values.size());
}

class CommittedReference : public testing::TestWithParam<std::string> {};

TEST_P(CommittedReference, IsWhatIsTracedToday) {
  const ExrFile file = read_exr(GetParam()).value();
  const BuiltInScene* built_in = find_built_in_scene(file.attributes.at("scene"));
  ASSERT_NE(built_in, nullptr) << file.attributes.at("scene");
  EXPECT_GE(std::stoul(file.attributes.at("samples")), 64u);
  EXPECT_EQ(file.attributes.at("bounces"), "unlimited");
  const Scene scene = built_in->make();
  PathReferenceDesc desc;
  desc.width = file.layers.front().image.width;
  desc.height = file.layers.front().image.height;
  EXPECT_EQ(desc.width, 320u);
  EXPECT_EQ(desc.height, 180u);
  desc.seed = 17;  // other samples than the file's
  const std::string seconds = file.attributes.at("seconds");
  if (seconds != "none") desc.seconds = std::stod(seconds);
  const auto reference = trace_reference(scene, desc, 4);
  for (const PathSums::Layer& layer : reference->sums().layers) {
    const ExrLayer* kept = find_layer(file, layer.name == "radiance" ? "" : layer.name);
    ASSERT_NE(kept, nullptr) << layer.name;
    ASSERT_EQ(kept->image.channels, layer.channels) << layer.name;
    EXPECT_EQ(file.attributes.count("error." + layer.name), 1u);
    // Four samples have fireflies: their own spread says how far off the mean may be.
    double error = 0;
    for (std::uint32_t c = 0; c < layer.channels; ++c) {
      error += error_of(*reference, layer.name, c) / layer.channels;
    }
    const double expected = mean_of_layer(kept->image);
    EXPECT_NEAR(mean_of_layer(reference->sums().mean(layer)), expected,
                6 * error + 0.01 * std::abs(expected) + 1e-4)
        << layer.name;
  }
}

std::string file_name_of(const testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).stem().string();
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Files, CommittedReference, testing::ValuesIn(reference_files()),
                         file_name_of);

}  // namespace
}  // namespace kaamos::effects
