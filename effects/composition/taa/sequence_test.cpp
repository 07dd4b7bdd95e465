// SPDX-License-Identifier: MIT
// Whole sequences: the same on any number of threads, with histories that follow what moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/assets/built_in/camera_paths.h"
#include "effects/assets/built_in/lounge.h"
#include "effects/assets/built_in/runner.h"
#include "effects/assets/image/flicker.h"
#include "effects/assets/image/metrics.h"
#include "effects/composition/taa/sequence_fixture.h"
#include "effects/denoise/denoise.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

constexpr double kFrameSeconds = 1.0 / 30.0;

// A signal of the frame with its denoiser.
struct Filtered {
  Filtered(SequenceStage& stage, const rtapi::Texture& sum, const DenoiseDesc& desc) {
    const DenoiseLibraries libraries = denoise_libraries().value();
    signal = stage.frame.create_picture(stage.device, "signal", rtapi::Format::kR32G32B32A32Float)
                 .value();
    denoiser = Denoiser::create(stage.device, stage.frame, libraries, "test", signal, desc).value();
    denoiser.create_load(stage.device, stage.frame, libraries, sum).value();
  }
  FloatImage run(SequenceStage& stage, std::uint32_t samples) {
    stage.run([&](rtapi::CommandList& list) {
      denoiser.load(list, stage.frame, 1.0f / static_cast<float>(samples));
      denoiser.dispatch(list, stage.frame);
    });
    return stage.read(denoiser.result());
  }
  rtapi::Texture signal;
  Denoiser denoiser;
};

// Renders some frames with every effect that has a history.
std::vector<float> frames(const Scene& scene, const std::string& path_name, std::uint32_t threads,
                          std::uint32_t count = 6, const std::string& backend = "embree") {
  SequenceStage stage(scene, 64, 36, threads, backend);
  const CameraPath path = make_camera_path(scene, path_name).value();
  Filtered ambient(stage, stage.ambient_sums.open, default_denoise(DenoiseMethod::kSvgf));
  Filtered sun(stage, stage.sun_sums.visible, default_denoise(DenoiseMethod::kTemporal));
  TemporalAntialiasing taa =
      TemporalAntialiasing::create(stage.device, stage.frame, taa_library().value()).value();
  std::vector<float> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    stage.camera = evaluate_camera(path, scene.cameras.front(), i * kFrameSeconds);
    stage.begin(i * kFrameSeconds, taa_jitter(i));
    stage.light(1);
    stage.run([&](rtapi::CommandList& list) { taa.dispatch(list, stage.frame); });
    for (const FloatImage& image :
         {ambient.run(stage, 1), sun.run(stage, 1), stage.read(taa.result())}) {
      out.insert(out.end(), image.values.begin(), image.values.end());
    }
  }
  return out;
}

TEST(Sequence, RunnerIsTheSameOnOneThreadAndThree) {
  const Scene scene = make_runner_scene({.crowd = 4, .crowd_poses = 2});
  const std::vector<float> one = frames(scene, "orbit", 1);
  EXPECT_EQ(one, frames(scene, "orbit", 3));
  EXPECT_TRUE(std::all_of(one.begin(), one.end(), [](float v) { return std::isfinite(v); }));
}

TEST(Sequence, LoungeIsTheSameOnOneThreadAndThree) {
  const Scene scene = make_lounge();
  const std::vector<float> one = frames(scene, "dolly", 1);
  EXPECT_EQ(one, frames(scene, "dolly", 3));
  EXPECT_TRUE(std::all_of(one.begin(), one.end(), [](float v) { return std::isfinite(v); }));
}

TEST(Sequence, VulkanGivesTheSameFrames) {
  const std::string why = test::why_no_vulkan();
  if (!why.empty() && test::vulkan_is_required()) FAIL() << why;
  if (!why.empty()) GTEST_SKIP() << why;
  test::ValidationGuard guard;
  const Scene scene = make_runner_scene({.crowd = 1});
  const std::vector<float> embree = frames(scene, "orbit", 0, 3);
  const std::vector<float> vulkan = frames(scene, "orbit", 0, 3, "vulkan");
  ASSERT_EQ(embree.size(), vulkan.size());
  double squares = 0;
  std::size_t apart = 0;
  for (std::size_t i = 0; i < embree.size(); ++i) {
    const double difference = std::abs(embree[i] - vulkan[i]);
    ASSERT_TRUE(std::isfinite(difference)) << i;
    squares += std::min(difference * difference, 1.0);
    apart += difference > 0.02 ? 1 : 0;
  }
  const double rmse = std::sqrt(squares / static_cast<double>(embree.size()));
  RecordProperty("rmse", std::to_string(rmse));
  // Rays that graze an edge may hit its other side on the other backend.
  EXPECT_LT(rmse, 0.02);
  EXPECT_LT(static_cast<double>(apart), 0.01 * static_cast<double>(embree.size()));
}

// A walking figure, whose ambient occlusion accumulates at one ray per pixel: once with the motion
// of its vertices, and once as if nothing moved.
TEST(Sequence, HistoryFollowsASkinnedFigure) {
  Scene scene = make_runner_scene({.crowd = 0});
  scene.cameras.front().camera_to_world = look_at({0.8, 1.5, 3.6}, {0.8, 0.9, 0});
  constexpr std::uint32_t kWidth = 112, kHeight = 80, kFrames = 16;
  SequenceStage stage(scene, kWidth, kHeight);
  DenoiseDesc desc = default_denoise(DenoiseMethod::kTemporal);
  desc.constants.clip_gamma = 0.0f;
  Filtered moving(stage, stage.ambient_sums.open, desc),
      still(stage, stage.ambient_sums.open, desc);
  Filtered svgf(stage, stage.ambient_sums.open, default_denoise(DenoiseMethod::kSvgf));
  FloatImage with, without, filtered, raw;
  TemporalChange raw_change, with_change;
  FloatImage raw_before, with_before, z_before;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    stage.begin(i * kFrameSeconds);
    stage.light(1);
    with = moving.run(stage, 1);
    filtered = svgf.run(stage, 1);
    raw = stage.read(moving.signal);
    const FrameSurfaces surfaces = {stage.read(kViewZ), stage.read(kMotion)};
    if (i > 7) {
      raw_change.add(temporal_change(raw_before, raw, z_before, surfaces).value());
      with_change.add(temporal_change(with_before, with, z_before, surfaces).value());
    }
    raw_before = raw, with_before = with, z_before = surfaces.view_z;
    stage.write(kMotion, FloatImage(kWidth, kHeight, 4));
    without = still.run(stage, 1);
  }
  const FloatImage ids = stage.read(kIds);
  // Ambient occlusion of the last frame alone, as the reference.
  stage.light(512);
  FloatImage reference = stage.read(stage.ambient_sums.open);
  for (float& v : reference.values) v /= 512;
  const auto hero_error = [&](const FloatImage& image) {
    double sum = 0, count = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        if (ids.at(x, y, 0) != 2.0f) continue;
        sum += std::pow(image.at(x, y) - reference.at(x, y), 2);
        ++count;
      }
    }
    EXPECT_GT(count, 300);
    return std::sqrt(sum / count);
  };
  const double followed = hero_error(with), stood = hero_error(without), one = hero_error(raw);
  RecordProperty("rmse_raw", std::to_string(one));
  RecordProperty("rmse_without_motion", std::to_string(stood));
  RecordProperty("rmse_with_motion", std::to_string(followed));
  RecordProperty("rmse_svgf", std::to_string(hero_error(filtered)));
  RecordProperty("flicker_raw", std::to_string(raw_change.mean()));
  RecordProperty("flicker_accumulated", std::to_string(with_change.mean()));
  EXPECT_LT(followed, 0.6 * one);
  EXPECT_LT(followed, 0.75 * stood);
  EXPECT_LT(hero_error(filtered), 0.6 * one);
  EXPECT_LT(with_change.mean(), 0.3 * raw_change.mean());
}

}  // namespace
}  // namespace kaamos::effects
