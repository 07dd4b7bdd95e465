// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "effects/assets/common/file.h"
#include "effects/assets/image/compare.h"
#include "effects/assets/image/exr.h"
#include "effects/assets/image/heat_map.h"
#include "effects/assets/image/png.h"
#include "effects/assets/image/tonemap.h"

namespace kaamos::effects {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class ImageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("kaamos-image-test-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

FloatImage ramp(std::uint32_t width, std::uint32_t height, std::uint32_t channels) {
  FloatImage image(width, height, channels);
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = static_cast<float>(i) * 0.37f - 5.0f;
  return image;
}

TEST_F(ImageTest, PngRoundTripOfEachKind) {
  for (const std::uint32_t channels : {1u, 3u, 4u}) {
    ByteImage image;
    image.width = 7;
    image.height = 5;
    image.channels = channels;
    for (std::size_t i = 0; i < 35 * channels; ++i)
      image.values.push_back(static_cast<std::uint8_t>(i * 41 % 256));
    ASSERT_TRUE(write_png(path("a.png"), image).ok());
    const auto read = read_png(path("a.png"));
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(read.value().width, 7u);
    ASSERT_EQ(read.value().height, 5u);
    for (std::size_t p = 0; p < 35; ++p)
      for (std::size_t c = 0; c < 4; ++c) {
        const std::uint8_t expected = channels == 1  ? (c < 3 ? image.values[p] : 255)
                                      : c < channels ? image.values[p * channels + c]
                                                     : 255;
        ASSERT_EQ(read.value().values[p * 4 + c], expected) << channels << " " << p << " " << c;
      }
  }
}

TEST_F(ImageTest, PngRefusesWhatItCannotHold) {
  ByteImage image;
  image.width = image.height = 2;
  image.channels = 2;
  image.values.resize(8);
  EXPECT_FALSE(write_png(path("a.png"), image).ok()) << "2 channels";
  image.channels = 3;
  EXPECT_FALSE(write_png(path("a.png"), image).ok()) << "8 bytes for 12";
  image.width = 0;
  EXPECT_FALSE(write_png(path("a.png"), image).ok()) << "empty";
  EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

TEST_F(ImageTest, BrokenPngIsAnErrorAndNamesTheFile) {
  const std::string text = "\x89PNG\r\n\x1a\nnonsense";
  ASSERT_TRUE(
      write_file(path("bad.png"), std::vector<std::uint8_t>(text.begin(), text.end())).ok());
  const auto read = read_png(path("bad.png"));
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("bad.png"), std::string::npos);
}

TEST_F(ImageTest, ExrRoundTripKeepsLayersBitsAndAttributes) {
  ExrFile file;
  file.layers.push_back({"", ramp(9, 4, 3)});
  file.layers.push_back({"ao", ramp(9, 4, 1)});
  file.layers.push_back({"normal", ramp(9, 4, 3), false, {"X", "Y", "Z"}});
  file.layers.push_back({"half", FloatImage(9, 4, 1, 0.333251953125f), true});
  file.layers[1].image.at(0, 0) = kInfinity;
  file.layers[1].image.at(1, 0) = kNan;
  file.attributes["samples"] = "4096";
  const Status written = write_exr(path("a.exr"), file);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const auto read = read_exr(path("a.exr"));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value().attributes.at("samples"), "4096");
  ASSERT_EQ(read.value().layers.size(), file.layers.size());
  for (const ExrLayer& layer : file.layers) {
    const ExrLayer* found = find_layer(read.value(), layer.name);
    ASSERT_NE(found, nullptr) << layer.name;
    const auto difference = compare(layer.image, found->image);
    ASSERT_TRUE(difference.ok()) << difference.error().message;
    EXPECT_EQ(difference.value().unequal, 0u) << layer.name << describe(difference.value());
  }
  EXPECT_EQ(find_layer(read.value(), "normal")->channels,
            (std::vector<std::string>{"X", "Y", "Z"}));
}

// More blocks of lines than threads, and the process keeps its own number of OpenEXR's threads.
TEST_F(ImageTest, ExrIsTheSameFromAnyNumberOfThreads) {
  ExrFile file;
  file.layers.push_back({"", ramp(65, 200, 3)});
  file.layers.push_back({"ao", ramp(65, 200, 1)});
  const auto one = encode_exr(file, 1);
  ASSERT_TRUE(one.ok()) << one.error().message;
  ASSERT_TRUE(write_exr(path("a.exr"), file).ok());
  EXPECT_EQ(read_file(path("a.exr")).value(), one.value());
  for (const std::uint32_t threads : {0u, 2u, 4u}) {
    const auto many = encode_exr(file, threads);
    ASSERT_TRUE(many.ok()) << many.error().message;
    EXPECT_EQ(many.value(), one.value()) << threads << " threads";
  }
  EXPECT_FALSE(encode_exr(ExrFile{}, 2).ok()) << "no layer";
}

TEST_F(ImageTest, ExrWriteFailuresKeepTheEarlierFile) {
  ExrFile file;
  file.layers.push_back({"", ramp(2, 2, 3)});
  ASSERT_TRUE(write_exr(path("a.exr"), file).ok());
  const auto before = read_file(path("a.exr"));
  file.layers.push_back({"ao", ramp(3, 2, 1)});
  const Status other_size = write_exr(path("a.exr"), file);
  EXPECT_NE(other_size.error().message.find("\"ao\""), std::string::npos)
      << other_size.error().message;
  file.layers[1] = {"", ramp(2, 2, 1)};
  EXPECT_FALSE(write_exr(path("a.exr"), file).ok()) << "a name twice";
  EXPECT_FALSE(write_exr(path("a.exr"), ExrFile{}).ok()) << "no layer";
  EXPECT_EQ(read_file(path("a.exr")).value(), before.value());
}

TEST_F(ImageTest, CutExrIsAnError) {
  ExrFile file;
  file.layers.push_back({"", ramp(32, 32, 3)});
  ASSERT_TRUE(write_exr(path("a.exr"), file).ok());
  const std::vector<std::uint8_t> whole = read_file(path("a.exr")).value();
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{3}, std::size_t{40}, whole.size() / 2, whole.size() - 1}) {
    ASSERT_TRUE(write_file(path("cut.exr"), std::span(whole).subspan(0, size)).ok());
    EXPECT_FALSE(read_exr(path("cut.exr")).ok()) << size;
  }
}

TEST(Tonemap, FilmicKeepsOrderAndRange) {
  EXPECT_EQ(filmic(0.0f), 0.0f);
  EXPECT_EQ(filmic(-1.0f), 0.0f);
  EXPECT_EQ(filmic(kNan), 0.0f);
  EXPECT_EQ(filmic(kInfinity), 1.0f);
  float last = 0.0f;
  for (float x = 0.01f; x < 5.0f; x += 0.01f) {
    EXPECT_GE(filmic(x), last);
    last = filmic(x);
  }
}

TEST(Tonemap, BytesAreReadableOffThePicture) {
  FloatImage image(4, 1, 1);
  image.values = {0.0f, 0.5f, 2.0f, kNan};
  const ByteImage bytes = to_bytes(image);
  EXPECT_EQ(bytes.values, (std::vector<std::uint8_t>{0, 128, 255, 0}));
  EXPECT_EQ(to_bytes(image, 1.0f, 0.0f, true).values[1], 188) << "sRGB of 0.5";
}

TEST(Tonemap, ExposureScalesBeforeTheCurve) {
  FloatImage image(1, 1, 4, 0.1f);
  const ByteImage dark = tonemap(image, 1.0f), bright = tonemap(image, 4.0f);
  EXPECT_EQ(dark.channels, 3u);
  EXPECT_LT(dark.values[0], bright.values[0]);
}

TEST(Compare, KnownDifference) {
  FloatImage a(2, 2, 1, 0.5f), b = a;
  b.at(1, 0) = 0.7f;
  const auto d = compare(a, b);
  ASSERT_TRUE(d.ok());
  EXPECT_NEAR(d.value().mse, 0.01, 1e-7);
  EXPECT_NEAR(d.value().psnr, 20.0, 1e-4);
  EXPECT_NEAR(d.value().bias, -0.05, 1e-7);
  EXPECT_EQ(d.value().unequal, 1u);
  EXPECT_EQ(d.value().worst_x, 1u);
  EXPECT_EQ(d.value().worst_y, 0u);
}

TEST(Compare, NonFiniteValues) {
  FloatImage a(3, 1, 1, 0.0f);
  a.values = {kNan, kInfinity, 1.0f};
  EXPECT_EQ(compare(a, a).value().unequal, 0u);
  FloatImage b = a;
  b.values[0] = 0.0f;
  EXPECT_EQ(compare(a, b).value().max_abs, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(compare(a, FloatImage(2, 1, 1)).ok());
}

TEST(HeatMap, GoesFromBlackToWhiteAndLeavesOutliersWhite) {
  std::vector<std::uint32_t> counts(2000, 4);
  counts[0] = 0;
  counts[1] = 1;
  counts[2] = 900;  // 1 of 2000 does not set the scale
  const HeatMap map = heat_map(100, 20, counts);
  EXPECT_EQ(map.white, 4u);
  EXPECT_EQ(map.most, 900u);
  EXPECT_NEAR(map.mean, (1997 * 4.0 + 901) / 2000, 1e-9);
  const auto color = [&](std::size_t pixel) {
    const auto* p = &map.image.values[pixel * 3];
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  EXPECT_EQ(color(0), (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(color(1), (std::array<int, 3>{30, 40, 160}));
  EXPECT_EQ(color(2), (std::array<int, 3>{255, 255, 255}));
  EXPECT_EQ(color(3), (std::array<int, 3>{255, 255, 255}));
  // Fewer counts than pixels, or none at all.
  EXPECT_EQ(heat_map(2, 1, {}).image.values, std::vector<std::uint8_t>(6, 0));
  EXPECT_EQ(heat_map(0, 0, {}).white, 1u);
}

}  // namespace
}  // namespace kaamos::effects
