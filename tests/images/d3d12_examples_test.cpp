// SPDX-License-Identifier: MIT
// Each D3D12 program renders what the same program on rtapi does, on either backend.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "effects/assets/image/png.h"
#include "tests/vulkan/support.h"

namespace {

namespace fs = std::filesystem;

struct Picture {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<uint8_t> rgb;
};

Picture read_ppm(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string magic;
  int largest = 0;
  Picture out;
  in >> magic >> out.width >> out.height >> largest;
  in.get();
  out.rgb.assign(std::istreambuf_iterator<char>(in), {});
  EXPECT_EQ(magic, "P6");
  EXPECT_EQ(out.rgb.size(), size_t{3} * out.width * out.height);
  return out;
}

// Renders `name` by both programs, and counts the pixels that differ.
void compare(const std::string& name, const std::string& backend) {
  const fs::path folder = fs::path(KAAMOS_BINARY_DIR) / "pictures" / "d3d12" / backend;
  fs::create_directories(folder);
  const std::string bin = std::string(KAAMOS_BINARY_DIR) + "/bin/";
  const std::string png = (folder / (name + ".png")).string();
  const std::string ppm = (folder / (name + ".ppm")).string();
  ASSERT_EQ(std::system((bin + name + " --backend " + backend + " --size 320x180 --out " + png +
                         " > /dev/null")
                            .c_str()),
            0);
  ASSERT_EQ(std::system(("KAAMOS_BACKEND=" + backend + " " + bin + "d3d12-" + name +
                         " --size 320x180 --out " + ppm)
                            .c_str()),
            0);
  const auto expected = kaamos::effects::read_png(png);
  ASSERT_TRUE(expected.ok()) << expected.error().message;
  const Picture picture = read_ppm(ppm);
  ASSERT_EQ(picture.width, expected->width);
  ASSERT_EQ(picture.height, expected->height);
  size_t differing = 0;
  for (size_t i = 0; i < size_t{picture.width} * picture.height; ++i) {
    for (size_t c = 0; c < 3; ++c) {
      if (picture.rgb[3 * i + c] != expected->values[expected->channels * i + c]) {
        ++differing;
        break;
      }
    }
  }
  EXPECT_EQ(differing, 0u) << "pixels of " << ppm << " differ from " << png;
}

class D3d12Example : public testing::TestWithParam<const char*> {};

TEST_P(D3d12Example, RendersOnEmbreeWhatTheSameProgramOnRtapiDoes) {
  compare(GetParam(), "embree");
}

TEST_P(D3d12Example, RendersOnVulkanWhatTheSameProgramOnRtapiDoes) {
  KAAMOS_NEED_VULKAN();
  if (const std::string why = kaamos::test::why_driver_cannot_compile(GetParam()); !why.empty()) {
    GTEST_SKIP() << why;
  }
  compare(GetParam(), "vulkan");
}

void expect_window_shows_triangle(const std::string& backend) {
  const fs::path folder = fs::path(KAAMOS_BINARY_DIR) / "pictures" / "d3d12" / backend / "window";
  fs::remove_all(folder);
  const std::string bin = std::string(KAAMOS_BINARY_DIR) + "/bin/";
  const std::string ppm = (folder.parent_path() / "shown.ppm").string();
  const std::string variables = "KAAMOS_BACKEND=" + backend + " KAAMOS_FRAMES=2 KAAMOS_PRESENT=";
  ASSERT_EQ(
      std::system((variables + folder.string() + " " + bin + "d3d12-01-triangle-window").c_str()),
      0);
  ASSERT_EQ(
      std::system(
          ("KAAMOS_BACKEND=" + backend + " " + bin + "d3d12-01-triangle --out " + ppm).c_str()),
      0);
  const Picture expected = read_ppm(ppm);
  for (const char* frame : {"frame_00000.png", "frame_00001.png"}) {
    const auto shown = kaamos::effects::read_png((folder / frame).string());
    ASSERT_TRUE(shown.ok()) << shown.error().message;
    ASSERT_EQ(shown->width, expected.width);
    ASSERT_EQ(shown->height, expected.height);
    for (size_t i = 0; i < expected.rgb.size(); ++i) {
      ASSERT_EQ(shown->values[shown->channels * (i / 3) + i % 3], expected.rgb[i])
          << frame << ", value " << i;
    }
  }
  EXPECT_FALSE(fs::exists(folder / "frame_00002.png"));
}

TEST(D3d12Window, PresentsOnEmbreeWhatTheProgramWithoutAWindowRenders) {
  expect_window_shows_triangle("embree");
}

TEST(D3d12Window, PresentsOnVulkanWhatTheProgramWithoutAWindowRenders) {
  KAAMOS_NEED_VULKAN();
  expect_window_shows_triangle("vulkan");
}

INSTANTIATE_TEST_SUITE_P(Programs, D3d12Example,
                         testing::Values("01-triangle", "04-procedural-spheres",
                                         "05-callable-and-recursion", "06-local-root-signature",
                                         "07-update-and-compaction", "13-hybrid", "14-reordering"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name) {
                             if (c == '-') c = '_';
                           }
                           return name;
                         });

}  // namespace
