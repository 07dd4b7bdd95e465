// SPDX-License-Identifier: MIT
// Tests what static pictures converge to, what moving ones leave behind, and broken input.
#include "effects/composition/taa/taa.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/built_in/runner.h"
#include "effects/assets/image/metrics.h"
#include "effects/composition/taa/sequence_fixture.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 80, kHeight = 50;

FloatImage rgb(const FloatImage& image) {
  FloatImage out(image.width, image.height, 3);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = image.values[i / 3 * image.channels + i % 3];
  }
  return out;
}

double error(const FloatImage& picture, const FloatImage& reference,
             std::span<const std::uint8_t> mask = {}) {
  return measure(rgb(picture), rgb(reference), mask).value().rmse;
}

// A static figure in front of floor and sky: it has edges of all slopes.
class Taa : public testing::Test {
 protected:
  Taa() : stage_(make_runner_scene({.crowd = 3}), kWidth, kHeight) {}

  TemporalAntialiasing make(const TaaConstants& constants = {}) {
    return TemporalAntialiasing::create(stage_.device, stage_.frame, taa_library().value(),
                                        constants)
        .value();
  }
  void render(const glm::vec2& jitter) {
    stage_.begin(0.0, jitter);
    stage_.light_by_the_sky();
  }
  FloatImage resolve(TemporalAntialiasing& taa) {
    stage_.run([&](rtapi::CommandList& list) { taa.dispatch(list, stage_.frame); });
    return stage_.read(taa.result());
  }
  // The mean of the next `count` jittered frames.
  FloatImage supersampled(std::uint32_t count) {
    FloatImage sum(kWidth, kHeight, 4);
    for (std::uint32_t i = 0; i < count; ++i) {
      // A different sequence from the one under test. [Roberts 2018: R2]
      render({std::fmod(0.5 + 0.7548776662 * i, 1.0) - 0.5,
              std::fmod(0.5 + 0.5698402910 * i, 1.0) - 0.5});
      const FloatImage one = stage_.read(kRadiance);
      for (std::size_t k = 0; k < sum.values.size(); ++k) {
        sum.values[k] += one.values[k] / static_cast<float>(count);
      }
    }
    return sum;
  }
  FloatImage filled(const std::function<float(std::uint32_t, std::uint32_t)>& value) {
    FloatImage image(kWidth, kHeight, 4);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        for (std::uint32_t c = 0; c < 3; ++c) {
          image.at(x, y, c) = value(x, y) * (1 + 0.3f * static_cast<float>(c));
        }
      }
    }
    return image;
  }

  SequenceStage stage_;
};

TEST(TaaJitter, CoversThePixelEvenly) {
  glm::vec2 mean(0.0f);
  std::set<std::pair<int, int>> quarters;
  for (std::uint32_t i = 0; i < kTaaJitterPeriod; ++i) {
    const glm::vec2 j = taa_jitter(i);
    EXPECT_LE(std::abs(j.x), 0.5f);
    EXPECT_LE(std::abs(j.y), 0.5f);
    mean += j / static_cast<float>(kTaaJitterPeriod);
    quarters.insert({static_cast<int>(4 * (j.x + 0.5f)), static_cast<int>(4 * (j.y + 0.5f))});
  }
  EXPECT_LT(std::abs(mean.x), 0.05f);
  EXPECT_LT(std::abs(mean.y), 0.05f);
  EXPECT_GE(quarters.size(), 11u);  // of 16
  EXPECT_EQ(taa_jitter(3), taa_jitter(3 + kTaaJitterPeriod));
}

TEST_F(Taa, FirstFrameIsItsInputAndSoIsTheOneBehindACut) {
  TemporalAntialiasing taa = make();
  render(taa_jitter(0));
  EXPECT_EQ(rgb(resolve(taa)).values, rgb(stage_.read(kRadiance)).values);
  render(taa_jitter(1));
  EXPECT_NE(rgb(resolve(taa)).values, rgb(stage_.read(kRadiance)).values);
  stage_.camera.camera_to_world = look_at({-3, 1, 2}, {0, 0.9, 0});
  render(taa_jitter(2));
  taa.reset();
  const FloatImage cut = resolve(taa);
  EXPECT_EQ(rgb(cut).values, rgb(stage_.read(kRadiance)).values);
  for (std::uint32_t y = 0; y < kHeight; ++y) ASSERT_EQ(cut.at(7, y, 3), 1.0f);
}

TEST_F(Taa, StandingSceneConvergesToTheSupersampledPicture) {
  const FloatImage reference = supersampled(256);
  TemporalAntialiasing taa = make();
  std::vector<double> errors;
  for (std::uint32_t i = 0; i < 64; ++i) {
    render(taa_jitter(i));
    errors.push_back(error(resolve(taa), reference));
  }
  const auto mean_of = [&](std::size_t from, std::size_t to) {
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += errors[i];
    return sum / static_cast<double>(to - from);
  };
  RecordProperty("rmse_frame_1", std::to_string(errors[0]));
  RecordProperty("rmse_frame_16", std::to_string(errors[15]));
  RecordProperty("rmse_frame_64", std::to_string(errors[63]));
  EXPECT_LT(mean_of(3, 5), 0.75 * errors[0]) << errors[0];
  EXPECT_LT(mean_of(12, 20), 0.55 * errors[0]) << errors[0];
  EXPECT_LT(mean_of(56, 64), 0.5 * errors[0]) << errors[0];
  // Without clipping and with equal weights the result is the mean, whose error keeps falling.
  TemporalAntialiasing plain = make({.alpha = 0.0f, .clip_gamma = 0.0f});
  FloatImage out;
  for (std::uint32_t i = 0; i < 64; ++i) {
    render(taa_jitter(i));
    out = resolve(plain);
  }
  EXPECT_LT(error(out, reference), 0.2 * errors[0]);
  EXPECT_EQ(out.at(3, 3, 3), 64.0f);
}

// The camera passes the figures: nothing of them may remain where they were a moment ago.
TEST_F(Taa, MovingCameraLeavesNoTrail) {
  TemporalAntialiasing taa = make();
  // No clipping, no motion vectors, no occlusion test: what a plain mean over frames would give.
  TemporalAntialiasing naive = make({.alpha = 0.1f, .clip_gamma = 0.0f, .depth_tolerance = 2.0f});
  TemporalAntialiasing unclipped = make({.clip_gamma = 0.0f});
  FloatImage ids, raw, out, naive_out, unclipped_out;
  std::vector<std::uint8_t> uncovered(kWidth * kHeight, 0), covered = uncovered;
  constexpr int kFrames = 8;
  for (int i = 0; i < kFrames; ++i) {
    stage_.camera.camera_to_world = look_at({0.25 * i - 1, 1.7, 4.6}, {0.25 * i - 1.6, 0.9, 0});
    render(taa_jitter(static_cast<std::uint32_t>(i)));
    ids = stage_.read(kIds);
    raw = stage_.read(kRadiance);
    out = resolve(taa);
    unclipped_out = resolve(unclipped);
    stage_.write(kMotion, FloatImage(kWidth, kHeight, 4));
    naive_out = resolve(naive);
    for (std::size_t k = 0; k < covered.size(); ++k) {
      const bool figure = ids.values[2 * k] > 1.0f;
      if (i + 1 == kFrames) {
        uncovered[k] = covered[k] != 0 && !figure ? 1 : 0;
      } else if (i >= kFrames - 6) {
        covered[k] |= figure ? 1 : 0;
      }
    }
  }
  // Leave out edges, where a single sample per pixel has a larger error than a trail is bright.
  for (std::uint32_t k = 0; k < uncovered.size(); ++k) {
    const std::uint32_t x = k % kWidth, y = k / kWidth;
    for (std::uint32_t i = 0; i < 9 && uncovered[k] != 0; ++i) {
      const std::uint32_t nx = std::clamp(x + i % 3, 1u, kWidth) - 1;
      const std::uint32_t ny = std::clamp(y + i / 3, 1u, kHeight) - 1;
      if (ids.at(nx, ny, 0) != ids.at(x, y, 0)) uncovered[k] = 0;
    }
  }
  const FloatImage reference = supersampled(64);
  ASSERT_GT(std::accumulate(uncovered.begin(), uncovered.end(), 0), 200);
  const double trail = error(out, reference, uncovered);
  const double naive_trail = error(naive_out, reference, uncovered);
  RecordProperty("trail", std::to_string(trail));
  RecordProperty("trail_unclipped", std::to_string(error(unclipped_out, reference, uncovered)));
  RecordProperty("trail_naive", std::to_string(naive_trail));
  RecordProperty("trail_raw", std::to_string(error(raw, reference, uncovered)));
  RecordProperty("all", std::to_string(error(out, reference)));
  RecordProperty("all_raw", std::to_string(error(raw, reference)));
  EXPECT_LT(trail, 0.15 * naive_trail);
  // Motion vectors and the depth test alone do most of it.
  EXPECT_LT(error(unclipped_out, reference, uncovered), 0.5 * naive_trail);
  EXPECT_LT(error(out, reference), error(raw, reference));
}

TEST_F(Taa, TurningCameraCarriesTheSkyAlong) {
  TemporalAntialiasing taa = make();
  FloatImage out;
  constexpr std::uint32_t kFrames = 12;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    stage_.camera.camera_to_world = look_at({0, 1.7, 4.6}, {0.05 * i, 2.4, 0});
    render(taa_jitter(i));
    out = resolve(taa);
  }
  const FloatImage ids = stage_.read(kIds);
  int sky = 0;
  for (std::uint32_t x = 0; x < kWidth / 2; ++x) {
    if (ids.at(x, 1, 0) != 0) continue;
    ++sky;
    EXPECT_EQ(out.at(x, 1, 3), kFrames) << x;  // the history is never lost
  }
  EXPECT_GT(sky, 30);
}

TEST_F(Taa, WhatIsNotFiniteIsGoneAfterAFrame) {
  render({0, 0});
  TemporalAntialiasing taa = make();
  const FloatImage clean = filled([](auto, auto) { return 0.5f; });
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity(),
                       1e38f,
                       65504.0f,
                       1e-42f};
  const FloatImage dirty =
      filled([&](auto x, auto y) { return x % 7 == 3 && y % 7 == 3 ? bad[x / 7 % 6] : 0.5f; });
  for (int i = 0; i < 3; ++i) {
    stage_.write(kRadiance, clean);
    resolve(taa);
  }
  stage_.write(kRadiance, dirty);
  FloatImage out = resolve(taa);
  for (const float v : out.values) ASSERT_TRUE(std::isfinite(v));
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      // No further than the clip box reaches, and where it was NaN not even there.
      const auto away = [](std::uint32_t at) { return (at + 4) % 7 > 1 && (at + 4) % 7 < 6; };
      const bool far = away(x) || away(y);
      const bool no_number = x % 7 == 3 && y % 7 == 3 && x / 7 % 6 < 3;
      if (far || no_number) {
        ASSERT_NEAR(out.at(x, y), 0.5, 1e-5) << x << "," << y;
      }
    }
  }
  stage_.write(kRadiance, clean);
  out = resolve(taa);
  for (std::size_t k = 0; k < out.values.size(); k += 4) ASSERT_NEAR(out.values[k], 0.5, 1e-5);
}

TEST_F(Taa, AllNotFiniteIsBlackAndNotForEver) {
  render({0, 0});
  TemporalAntialiasing taa = make();
  stage_.write(kRadiance,
               filled([](auto, auto) { return std::numeric_limits<float>::quiet_NaN(); }));
  resolve(taa);
  FloatImage out = resolve(taa);
  for (std::size_t k = 0; k < out.values.size(); k += 4) ASSERT_EQ(out.values[k], 0.0f);
  stage_.write(kRadiance, filled([](auto, auto) { return 0.25f; }));
  out = resolve(taa);
  for (std::size_t k = 0; k < out.values.size(); k += 4) ASSERT_NEAR(out.values[k], 0.25, 1e-6);
}

TEST_F(Taa, ExposureChangesNothing) {
  const float scales[] = {1.0f, 0x1p-30f, 0x1p+40f, 1e6f};
  std::vector<FloatImage> results;
  for (const float scale : scales) {
    TemporalAntialiasing taa = make();
    FloatImage out;
    for (std::uint32_t i = 0; i < 4; ++i) {
      stage_.index = i;
      render(taa_jitter(i));
      FloatImage input = stage_.read(kRadiance);
      for (float& v : input.values) v *= scale;
      stage_.write(kRadiance, input);
      out = resolve(taa);
    }
    results.push_back(out);
  }
  for (std::size_t k = 0; k < results[0].values.size(); ++k) {
    if (k % 4 == 3) continue;
    const float one = results[0].values[k];
    ASSERT_EQ(results[1].values[k], one * 0x1p-30f) << k;
    ASSERT_EQ(results[2].values[k], one * 0x1p+40f) << k;
    ASSERT_NEAR(results[3].values[k], one * 1e6f, 2e-4f * one * 1e6f + 1e-3f) << k;
  }
  // Exposure 0 turns the frame black; no history may shine through.
  TemporalAntialiasing taa = make();
  render(taa_jitter(0));
  resolve(taa);
  stage_.write(kRadiance, FloatImage(kWidth, kHeight, 4));
  const FloatImage out = resolve(taa);
  for (std::size_t k = 0; k < out.values.size(); k += 4) ASSERT_EQ(out.values[k], 0.0f);
}

TEST_F(Taa, MotionThatLeadsNowhereStartsAnew) {
  render({0, 0});
  TemporalAntialiasing taa = make();
  stage_.write(kRadiance, filled([](auto, auto) { return 0.5f; }));
  resolve(taa);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float bad[] = {nan, 1e9f, -1e9f, std::numeric_limits<float>::infinity(), 1e38f, 0.99f};
  FloatImage motion(kWidth, kHeight, 4);
  for (std::size_t k = 0; k < motion.values.size(); ++k) {
    motion.values[k] = bad[k / 4 % kWidth / 3 % 6];
  }
  stage_.write(kMotion, motion);
  const FloatImage input = filled([](auto x, auto) { return 0.01f * static_cast<float>(x); });
  stage_.write(kRadiance, input);
  const FloatImage out = resolve(taa);
  const FloatImage ids = stage_.read(kIds);
  for (const float v : out.values) ASSERT_TRUE(std::isfinite(v));
  for (std::uint32_t y = 1; y + 1 < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (ids.at(x, y, 0) == 0 || ids.at(x, y - 1, 0) == 0) continue;  // the sky: it turns
      ASSERT_EQ(out.at(x, y), input.at(x, y)) << x << "," << y;
    }
  }
}

TEST(TaaSizes, TinyPicturesAndPixelCorners) {
  for (const auto& [width, height] : {std::pair(1u, 1u), std::pair(7u, 3u), std::pair(1u, 9u)}) {
    SequenceStage stage(make_sphere_oracle(1.0, 1.5), width, height);
    TemporalAntialiasing taa =
        TemporalAntialiasing::create(stage.device, stage.frame, taa_library().value()).value();
    for (const float corner : {0.5f, -0.5f, 0.5f}) {
      stage.begin(0.0, {corner, -corner});
      stage.light_by_the_sky();
      stage.run([&](rtapi::CommandList& list) { taa.dispatch(list, stage.frame); });
      for (const float v : stage.read(taa.result()).values) ASSERT_TRUE(std::isfinite(v));
    }
  }
}

}  // namespace
}  // namespace kaamos::effects
