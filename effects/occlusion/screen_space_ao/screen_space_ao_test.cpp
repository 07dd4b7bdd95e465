// SPDX-License-Identifier: MIT
// Screen-space ambient occlusion against closed forms, rays and the failures that each is known
// for.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "effects/northlight/frame_renderer.h"
#include "effects/occlusion/screen_space_ao/height_field_fixture.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr float kNoEnd = std::numeric_limits<float>::infinity();

// Looking straight down from so far that the view is parallel; a pixel is one metre.
constexpr double kFar = 20000;
double parallel_fov(std::uint32_t height) {
  return 2 * std::atan(0.5 * height / kFar);
}

class ScreenSpaceAoTest : public test::OnBackends {};

std::map<std::string, FloatImage> run_all(HeightField& field, float radius) {
  return {
      {"crytek", field.run(ScreenSpaceAoKind::kCrytek, CrytekConstants{}, radius)},
      {"remapped", field.run(ScreenSpaceAoKind::kCrytek, CrytekConstants{.remap = 1}, radius)},
      {"hemisphere", field.run(ScreenSpaceAoKind::kHemisphere, HemisphereConstants{}, radius)},
      {"hbao", field.run(ScreenSpaceAoKind::kHbao, HbaoConstants{}, radius)},
      {"gtao", field.run(ScreenSpaceAoKind::kGtao, GtaoConstants{}, radius)},
      {"accurate", field.run(ScreenSpaceAoKind::kGtao, accurate_gtao(4, 8), radius)},
      {"sweep", field.run(LineSweepSettings{4}, radius)},
  };
}

double mean(const FloatImage& image) {
  double sum = 0;
  for (const float v : image.values) sum += v;
  return sum / static_cast<double>(image.values.size());
}

// An open plane, tilted by half a right angle: grey for Crytek, white for all others.
TEST_P(ScreenSpaceAoTest, AnOpenPlaneIsGreyForCrytekOnly) {
  HeightField field(GetParam(), 48, 32, 0.9);
  const float half = std::tan(0.45f);
  field.fill(
      [&](std::uint32_t, std::uint32_t y) {
        const float slope = half * (1 - (static_cast<float>(y) + 0.5f) / 16);
        return 1 / (1 - slope);  // z = 1 + y, up is farther
      },
      [](std::uint32_t, std::uint32_t) { return glm::vec3(0, 1, -1) * std::sqrt(0.5f); });
  for (const auto& [name, picture] : run_all(field, 0.25f)) {
    if (name == "crytek") {
      EXPECT_NEAR(mean(picture), 0.5, 0.03);
      continue;
    }
    // The depth of a whole pixel may put one point of 16 on the wrong side; horizons are exact.
    const bool has_points = name == "remapped" || name == "hemisphere";
    EXPECT_GE(mean(picture), has_points ? 1 - 1.0 / 16 : 0.99) << name;
  }
}

// One slice of an open plane that is seen aslant sees more than everything or less, by its
// direction; the mean of neighbours, which have other directions, is what is open.
TEST_P(ScreenSpaceAoTest, OneSliceOfATiltedPlaneKeepsTheEnergy) {
  HeightField field(GetParam(), 48, 32, 0.5);
  const float half = std::tan(0.25f), tilt = std::tan(1.0472f);  // 60 degrees
  field.fill(
      [&](std::uint32_t, std::uint32_t y) {
        const float slope = half * (1 - (static_cast<float>(y) + 0.5f) / 16);
        return 1 / (1 - tilt * slope);  // z = 1 + tan(60) y
      },
      [](std::uint32_t, std::uint32_t) { return glm::vec3(0, 0.8660254f, -0.5f); });
  GtaoConstants constants;
  constants.slices = 1;
  constants.steps = 2;
  for (const float power : {1.0f, 2.2f}) {
    constants.final_power = power;
    EXPECT_GT(mean(field.run(ScreenSpaceAoKind::kGtao, constants, 0.25f)), 0.97) << power;
  }
}

// A wall seen from above: HBAO and GTAO in closed form. The wall ends 60 m to each side.
TEST(ScreenSpaceAo, CornersByHbaoGtaoAndSweptLines) {
  constexpr std::uint32_t kWidth = 14, kHeight = 120, kAway = 6;  // metres, the column 7
  HeightField field("embree", kWidth, kHeight, parallel_fov(kHeight));
  const double hbao_values[] = {0.578, 0.750, 0.898};
  int i = 0;
  for (const double x : {0.25, 1.0, 3.0}) {
    const auto wall = static_cast<float>(kAway / x);
    field.fill([&](std::uint32_t column, std::uint32_t) {
      return static_cast<float>(kFar) - (column < 2 ? wall : 0);
    });
    const auto at = [](const FloatImage& picture) { return picture.at(7, kHeight / 2); };
    const double truth = 1 - wall_occlusion(1, x);
    const HbaoConstants hbao = {
        .filter_passes = 0, .directions = 64, .steps = 120, .angle_bias = 0, .most_pixels = 120};
    EXPECT_NEAR(at(field.run(ScreenSpaceAoKind::kHbao, hbao, kNoEnd)), hbao_values[i++], 0.01) << x;
    GtaoConstants gtao = accurate_gtao(32, 120);
    // A step is a pixel in any case, so noise would leave pixels out.
    gtao.noise = 0;
    EXPECT_NEAR(at(field.run(ScreenSpaceAoKind::kGtao, gtao, kNoEnd)), truth, 5e-3) << x;
    EXPECT_NEAR(at(field.run(LineSweepSettings{32})), truth, 5e-3) << x;
  }
}

// Swept lines find the horizons that GTAO finds with a step for every pixel.
TEST_P(ScreenSpaceAoTest, SweptLinesAreGtaoWithEveryStep) {
  constexpr std::uint32_t kSize = 32;
  HeightField field(GetParam(), kSize, kSize, parallel_fov(kSize));
  field.fill([](std::uint32_t x, std::uint32_t y) {
    const std::uint32_t bump = (x * 7 + y * 13 + x * y) % 11;
    return static_cast<float>(kFar) - static_cast<float>(bump);
  });
  GtaoConstants gtao = accurate_gtao(4, 128);  // rows, columns and diagonals go through all pixels
  gtao.noise = 0;
  const FloatImage steps = field.run(ScreenSpaceAoKind::kGtao, gtao, kNoEnd);
  const FloatImage lines = field.run(LineSweepSettings{4});
  for (std::size_t i = 0; i < lines.values.size(); ++i) {
    // Depths of 20 km are rounded to 2 mm, heights are metres.
    ASSERT_NEAR(lines.values[i], steps.values[i], 2e-3) << i % kSize << ", " << i / kSize;
  }
  EXPECT_LT(mean(lines), 0.8);
}

// Broken depths and normals, no radius, a huge one, pictures of one pixel.
TEST(ScreenSpaceAo, ExtremesGiveNumbers) {
  HeightField field("embree", 20, 12, 0.9);
  field.fill(
      [](std::uint32_t x, std::uint32_t y) {
        if (x == 3) return 0.0f;  // sky
        if (x == 5) return std::numeric_limits<float>::infinity();
        if (x == 7) return std::numeric_limits<float>::quiet_NaN();
        return y == 5 ? 0.01f : 4.0f;
      },
      [](std::uint32_t x, std::uint32_t) { return glm::vec3(x % 2 ? 1 : -1, 0, 0); });
  for (const float radius : {0.0f, 0.5f, 1e4f, kNoEnd}) {
    for (const auto& [name, picture] : run_all(field, radius)) {
      for (std::size_t i = 0; i < picture.values.size(); ++i) {
        const std::size_t x = i % 20;
        const float v = picture.values[i];
        ASSERT_TRUE(v >= 0 && v <= 1) << name << " " << radius << ": " << v;
        if (radius == 0 || x == 3 || x == 5 || x == 7) {
          ASSERT_EQ(v, 1) << name;
        }
      }
    }
  }
  HeightField one("embree", 1, 1, 0.9);
  one.fill([](std::uint32_t, std::uint32_t) { return 2.0f; });
  for (const auto& [name, picture] : run_all(one, 0.5f)) {
    EXPECT_TRUE(picture.values[0] >= (name == "crytek" ? 0 : 0.9)) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, ScreenSpaceAoTest, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// Against rays of the same length, over things on a plane: each step from fast to accurate is one.
TEST(ScreenSpaceAo, AgainstRaysOfTheSameLength) {
  const Scene scene = make_oracle_box();
  FrameSettings settings;
  settings.width = 96;
  settings.height = 54;
  settings.effects = choose_effects(
      {"ao", "crytek-ao", "crytek-ao-remapped", "hemisphere-ao", "hbao", "gtao", "gtao-accurate"});
  for (auto& [name, effect] : settings.effects) effect.radius = 0.5f;
  settings.effects.at("ao").samples = 256;
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  const auto renderer =
      FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  renderer->render().value();
  const FloatImage rays = renderer->read("ao").value();
  const auto error = [&](const char* layer) {
    const FloatImage picture = renderer->read(layer).value();
    double sum = 0;
    for (std::size_t i = 0; i < rays.values.size(); ++i) {
      const double off = picture.values[4 * i] - rays.values[i];
      sum += off * off;
    }
    const double rmse = std::sqrt(sum / static_cast<double>(rays.values.size()));
    std::printf("%s: %.4f\n", layer, rmse);
    return rmse;
  };
  const double crytek = error("crytek_ao"), remapped = error("crytek_ao_remapped");
  const double gtao = error("gtao"), accurate = error("gtao_accurate");
  EXPECT_NEAR(crytek, 0.4, 0.1) << "grey walls";
  EXPECT_LT(remapped, crytek / 2);
  EXPECT_LT(error("hemisphere_ao"), crytek / 2) << "far pixels are wider than points are apart";
  const double hbao = error("hbao");
  EXPECT_LT(gtao, hbao);
  // What the picture does not have is missing in both; here GTAO's filter gains a little more than
  // more slices do.
  EXPECT_LT(accurate, hbao);
  EXPECT_NEAR(accurate, gtao, 0.01);
}

}  // namespace
}  // namespace kaamos::effects
