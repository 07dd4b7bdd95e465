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

// The third frame of all that GTAO can do.
FloatImage over_frames(HeightField& field, float radius) {
  GtaoConstants constants = gtao_over_frames();
  constants.multibounce = 1;
  constants.bent_normals = 1;
  FloatImage out;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    field.set_frame(frame);
    out = field.run(ScreenSpaceAoKind::kGtao, constants, radius);
  }
  field.set_frame(0);
  field.forget(ScreenSpaceAoKind::kGtao);
  return out;
}

// Fails where a normal is none.
FloatImage bent(HeightField& field, float radius) {
  const FloatImage out =
      field.run(ScreenSpaceAoKind::kGtao, GtaoConstants{.bent_normals = 1}, radius);
  const FloatImage normals = field.bent();
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    if (out.values[i] == 1) continue;  // may be the sky
    const float* n = &normals.values[4 * i];
    EXPECT_NEAR(glm::length(glm::vec3(n[0], n[1], n[2])), 1, 1e-4);
  }
  return out;
}

std::map<std::string, FloatImage> run_all(HeightField& field, float radius) {
  return {
      {"crytek", field.run(ScreenSpaceAoKind::kCrytek, CrytekConstants{}, radius)},
      {"remapped", field.run(ScreenSpaceAoKind::kCrytek, CrytekConstants{.remap = 1}, radius)},
      {"hemisphere", field.run(ScreenSpaceAoKind::kHemisphere, HemisphereConstants{}, radius)},
      {"hbao", field.run(ScreenSpaceAoKind::kHbao, HbaoConstants{}, radius)},
      {"gtao", field.run(ScreenSpaceAoKind::kGtao, GtaoConstants{}, radius)},
      {"accurate", field.run(ScreenSpaceAoKind::kGtao, accurate_gtao(4, 8), radius)},
      {"over frames", over_frames(field, radius)},
      {"bent", bent(field, radius)},
      {"half hbao", field.run(ScreenSpaceAoKind::kHbao,
                              HbaoConstants{.half_resolution = 1, .rotations = 6}, radius)},
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

// Bumps of up to 10 m, a metre apart.
void fill_bumps(HeightField& field) {
  field.fill([](std::uint32_t x, std::uint32_t y) {
    const std::uint32_t bump = (x / 4 * 7 + y / 4 * 13 + x / 4 * (y / 4)) % 11;
    return static_cast<float>(kFar) - static_cast<float>(bump);
  });
}

double rmse(const FloatImage& a, const FloatImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double off = a.values[i] - b.values[i];
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(a.values.size()));
}

// One slice without clamps and powers, whose error is that of its direction alone.
GtaoConstants one_slice() {
  GtaoConstants constants = accurate_gtao(1, 32);
  constants.rotations = 6;
  constants.fresh = 0.001f;  // the plain mean
  return constants;
}

// Six frames have six directions for each pixel; the same direction again would gain nothing.
TEST(ScreenSpaceAo, RotationsOverFramesFindWhatMoreDirectionsFind) {
  constexpr std::uint32_t kSize = 48;
  HeightField field("embree", kSize, kSize, parallel_fov(kSize));
  fill_bumps(field);
  const FloatImage truth = field.run(ScreenSpaceAoKind::kGtao, accurate_gtao(48, 32), 24);
  const auto errors = [&](const GtaoConstants& constants) {
    field.forget(ScreenSpaceAoKind::kGtao);
    std::vector<double> out;
    for (std::uint32_t frame = 0; frame < 12; ++frame) {
      field.set_frame(frame);
      out.push_back(rmse(field.run(ScreenSpaceAoKind::kGtao, constants, 24), truth));
    }
    return out;
  };
  const auto rotating = errors(one_slice());
  GtaoConstants still = one_slice();
  still.rotations = 1;
  const auto same = errors(still);
  std::printf("RMSE after 1, 2, 3, 6, 12 frames: %.4f, %.4f, %.4f, %.4f, %.4f; same: %.4f\n",
              rotating[0], rotating[1], rotating[2], rotating[5], rotating[11], same[11]);
  EXPECT_LT(rotating[1], rotating[0]);
  EXPECT_LT(rotating[5], 0.3 * rotating[0]);
  EXPECT_GT(same[11], 0.8 * same[0]);
}

// Half as many pixels to each side: energy stays, and the error is that of what lies between them.
// Over four frames all pixels are looked at.
TEST(ScreenSpaceAo, HalfResolutionKeepsEnergyAndFramesBringTheRest) {
  constexpr std::uint32_t kWidth = 47, kHeight = 33;  // the last blocks are cut
  HeightField field("embree", kWidth, kHeight, parallel_fov(kHeight));
  fill_bumps(field);
  const FloatImage truth = field.run(ScreenSpaceAoKind::kGtao, accurate_gtao(48, 32), 24);
  GtaoConstants constants = accurate_gtao(16, 32);
  constants.noise = 0;
  const FloatImage full = field.run(ScreenSpaceAoKind::kGtao, constants, 24);
  constants.half_resolution = 1;
  const FloatImage half = field.run(ScreenSpaceAoKind::kGtao, constants, 24);
  constants.fresh = 0.001f;
  FloatImage over_time;
  for (std::uint32_t frame = 0; frame < 8; ++frame) {
    field.set_frame(frame);
    over_time = field.run(ScreenSpaceAoKind::kGtao, constants, 24);
  }
  std::printf("mean %.4f, half %.4f, over frames %.4f; RMSE %.4f, %.4f, %.4f\n", mean(full),
              mean(half), mean(over_time), rmse(full, truth), rmse(half, truth),
              rmse(over_time, truth));
  EXPECT_NEAR(mean(half), mean(truth), 0.02);
  EXPECT_NEAR(mean(over_time), mean(truth), 0.02);
  EXPECT_LT(rmse(half, truth), 0.15);
  EXPECT_LT(rmse(over_time, truth), 0.8 * rmse(half, truth));
}

// Where another surface is seen than in the frame before, the frame stands alone.
TEST(ScreenSpaceAo, WhatWasNotSeenBeforeHasNoHistory) {
  constexpr std::uint32_t kSize = 32;
  HeightField field("embree", kSize, kSize, 0.9);
  GtaoConstants constants = one_slice();
  constants.fresh = 0.1f;
  const auto fill = [&](float left) {
    field.fill([&](std::uint32_t x, std::uint32_t) {
      if (x >= kSize / 2) return 4.0f;
      return x < 4 ? left - 0.5f : left;
    });
  };
  fill(2);
  for (std::uint32_t frame = 0; frame < 6; ++frame) {
    field.set_frame(frame);
    field.run(ScreenSpaceAoKind::kGtao, constants, 0.5f);
  }
  fill(3);
  const FloatImage shown = field.run(ScreenSpaceAoKind::kGtao, constants, 0.5f);
  field.forget(ScreenSpaceAoKind::kGtao);
  const FloatImage alone = field.run(ScreenSpaceAoKind::kGtao, constants, 0.5f);
  for (std::uint32_t y = 0; y < kSize; ++y) {
    for (std::uint32_t x = 0; x < kSize / 2 - 1; ++x) {
      ASSERT_EQ(shown.at(x, y), alone.at(x, y)) << x << ", " << y;
    }
  }
}

TEST(ScreenSpaceAo, BouncesAreThoseOfThePictureOfColours) {
  constexpr std::uint32_t kSize = 32;
  HeightField field("embree", kSize, kSize, parallel_fov(kSize));
  fill_bumps(field);
  GtaoConstants constants = accurate_gtao(4, 16);
  const FloatImage plain = field.run(ScreenSpaceAoKind::kGtao, constants, 24);
  constants.multibounce = 1;
  field.paint(0);
  EXPECT_LT(rmse(field.run(ScreenSpaceAoKind::kGtao, constants, 24), plain), 1e-3);
  field.paint(255);
  const FloatImage white = field.run_colored(ScreenSpaceAoKind::kGtao, constants, 24);
  for (std::size_t i = 0; i < plain.values.size(); ++i) {
    const float v = plain.values[i];
    const float lit = ((v * 1.708f - 4.1534f) * v + 3.4455f) * v;  // of albedo 1
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(white.values[4 * i + c], std::min(std::max(v, lit), 1.0f), 2e-3);
    }
  }
  EXPECT_GT(mean(white), mean(plain) + 0.05);
}

// On an open plane it is the normal; beside a wall, what the open directions mean.
TEST(ScreenSpaceAo, BentNormalsOfAPlaneAndBesideAWall) {
  constexpr std::uint32_t kWidth = 14, kHeight = 120, kAway = 6;  // metres, the column 7
  HeightField field("embree", kWidth, kHeight, parallel_fov(kHeight));
  GtaoConstants constants = accurate_gtao(32, 120);
  constants.noise = 0;
  constants.bent_normals = 1;
  field.fill([](std::uint32_t, std::uint32_t) { return static_cast<float>(kFar); });
  field.run(ScreenSpaceAoKind::kGtao, constants, kNoEnd);
  EXPECT_GT(field.bent().at(7, kHeight / 2, 2), 0.9999f);
  for (const double x : {0.25, 1.0}) {
    const auto wall = static_cast<float>(kAway / x);
    field.fill([&](std::uint32_t column, std::uint32_t) {
      return static_cast<float>(kFar) - (column < 2 ? wall : 0);
    });
    field.run(ScreenSpaceAoKind::kGtao, constants, kNoEnd);
    const FloatImage picture = field.bent();
    // The wall is at the left, 1 high and x away. Directions of all azimuths and elevations.
    glm::dvec2 expected(0);
    constexpr int kSteps = 1000;
    for (int i = 0; i < kSteps; ++i) {
      const double azimuth = 3.14159265358979 * (i + 0.5) / kSteps;  // from the right
      const double towards = -std::cos(azimuth);
      const double horizon = towards > 0 ? std::atan(towards / x) : 0;
      for (int k = 0; k < kSteps; ++k) {
        const double elevation = 1.5707963267949 * (k + 0.5) / kSteps;
        if (elevation < horizon) continue;
        const double weight = std::sin(elevation) * std::cos(elevation);
        expected += weight * glm::dvec2(-towards * std::cos(elevation), std::sin(elevation));
      }
    }
    const double lean = std::atan2(picture.at(7, kHeight / 2, 0), picture.at(7, kHeight / 2, 2));
    std::printf("wall %g: leans by %.4f, exact %.4f\n", x, lean,
                std::atan2(expected.x, expected.y));
    EXPECT_NEAR(lean, std::atan2(expected.x, expected.y), 0.02) << x;
  }
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
  settings.effects = choose_effects({"ao", "crytek-ao", "crytek-ao-remapped", "hemisphere-ao",
                                     "hbao", "gtao", "gtao-accurate", "gtao-frames"});
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
  EXPECT_LT(error("gtao_frames"), crytek / 2) << "its first frame, of 48 x 27 pixels";
}

}  // namespace
}  // namespace kaamos::effects
