// SPDX-License-Identifier: MIT
//
// Each example renders the picture that was reviewed and committed (tests/images/reference). To
// accept a new picture, look at it, then copy it there from the folder that the message names.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "effects/assets/image/compare.h"
#include "effects/assets/image/png.h"

namespace {

namespace fs = std::filesystem;
using namespace kaamos::effects;

FloatImage floats(const ByteImage& image) {
  FloatImage out(image.width, image.height, image.channels);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    out.values[i] = static_cast<float>(image.values[i]) / 255.0f;
  }
  return out;
}

int run(const std::string& command) {
  return std::system((command + " > /dev/null").c_str());
}

class ExamplePicture : public testing::TestWithParam<const char*> {};

TEST_P(ExamplePicture, IsTheOneThatWasLookedAt) {
  const std::string name = GetParam();
  const fs::path folder = fs::path(KAAMOS_BINARY_DIR) / "pictures";
  fs::create_directories(folder);
  const std::string picture = (folder / (name + ".png")).string();
  const std::string program = std::string(KAAMOS_BINARY_DIR) + "/bin/" + name;
  ASSERT_EQ(run(program + " --size 320x180 --out " + picture), 0);

  const auto rendered = read_png(picture);
  ASSERT_TRUE(rendered.ok()) << rendered.error().message;
  const auto reference =
      read_png(std::string(KAAMOS_SOURCE_DIR) + "/tests/images/reference/" + name + ".png");
  ASSERT_TRUE(reference.ok()) << reference.error().message;
  const auto difference = compare(floats(rendered.value()), floats(reference.value()));
  ASSERT_TRUE(difference.ok()) << difference.error().message;
  // Processors differ in the last bit of a hit, which moves single pixels at edges.
  EXPECT_GT(difference.value().psnr, 40.0) << picture << ": " << describe(difference.value());
}

INSTANTIATE_TEST_SUITE_P(
    Examples, ExamplePicture,
    testing::Values("00-raygen-only", "01-triangle", "02-instances-and-masks", "03-any-hit-alpha",
                    "04-procedural-spheres", "05-callable-and-recursion", "06-local-root-signature",
                    "07-update-and-compaction", "08-compute", "09-ray-query", "11-triangle-raster",
                    "12-shadow-map", "13-hybrid", "14-reordering", "15-opacity-micromaps",
                    "16-partitioned-top-level", "17-clusters", "18-cluster-detail"),
    [](const auto& tested) {
      std::string name = tested.param;
      for (char& c : name) {
        if (c == '-') c = '_';
      }
      return name;
    });

// Small pictures of the lounge, with the noise of exactly these samples.
TEST(NorthlightPicture, IsTheOneThatWasLookedAt) {
  const std::string folder = std::string(KAAMOS_BINARY_DIR) + "/pictures/northlight";
  ASSERT_EQ(run(std::string(KAAMOS_BINARY_DIR) +
                "/bin/northlight --size 320x180 --ao-samples 16 --sun-samples 8 --layers "
                "ao,sun,shading_normal,base_color --out " +
                folder),
            0);
  for (const std::string name : {"frame", "ao", "sun", "shading_normal", "base_color"}) {
    const auto rendered = read_png(folder + "/" + name + ".png");
    ASSERT_TRUE(rendered.ok()) << rendered.error().message;
    const auto reference = read_png(std::string(KAAMOS_SOURCE_DIR) +
                                    "/tests/images/reference/northlight-" + name + ".png");
    ASSERT_TRUE(reference.ok()) << reference.error().message;
    const auto difference = compare(floats(rendered.value()), floats(reference.value()));
    ASSERT_TRUE(difference.ok()) << difference.error().message;
    EXPECT_GT(difference.value().psnr, 36.0) << name << ": " << describe(difference.value());
  }
}

TEST(ExampleErrors, AWrongOptionIsNamed) {
  const std::string program = std::string(KAAMOS_BINARY_DIR) + "/bin/00-raygen-only";
  EXPECT_NE(run(program + " --size 0x9 2> /dev/null"), 0);
  EXPECT_NE(run(program + " --backend nothing 2> /dev/null"), 0);
  EXPECT_NE(run(program + " --out /nowhere/picture.png 2> /dev/null"), 0);
}

}  // namespace
