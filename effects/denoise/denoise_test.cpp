// SPDX-License-Identifier: MIT
// What each method keeps and what it loses, on signals that are known.
#include "effects/denoise/denoise.h"

#include <gtest/gtest.h>

#include <rtapi/upload.h>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "effects/frame/picture.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/image/metrics.h"
#include "effects/scene/oracle_scenes.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 64, kHeight = 40;

// A sphere over a plane, its G-buffer, and one signal that the test writes.
class DenoiseTest : public testing::Test {
 protected:
  DenoiseTest() : scene_(make_sphere_oracle(1.0, 1.5)) {
    device_ = rtapi::CreateDevice().value();
    queue_ = device_.CreateCommandQueue().value();
    const Camera& camera = scene_.cameras.front();
    gpu_ = create_gpu_scene(device_, queue_, scene_, camera.position()).value();
    FrameDesc desc;
    desc.width = kWidth;
    desc.height = kHeight;
    frame_ = Frame::create(device_, queue_, scene_, gpu_, camera, desc).value();
    gbuffer_ =
        RayPass::create(device_, frame_, gpu_, gbuffer_pass(gbuffer_library().value())).value();
    signal_ = frame_.create_picture(device_, "signal", rtapi::Format::kR32G32B32A32Float).value();
    render_gbuffer();
  }

  void render_gbuffer() {
    rtapi::CommandList list = device_.CreateCommandList().value();
    gbuffer_.dispatch(list, frame_, {}, kHeight);
    queue_.ExecuteAndWait(list).value();
    view_z_ = frame_.read(device_, queue_, kViewZ).value();
    ids_ = frame_.read(device_, queue_, kIds).value();
    position_ = frame_.read(device_, queue_, kPosition).value();
  }

  Denoiser make(const DenoiseDesc& desc) {
    return Denoiser::create(device_, frame_, denoise_libraries().value(), "test", signal_, desc)
        .value();
  }

  // One frame of a grey signal.
  FloatImage run(Denoiser& denoiser,
                 const std::function<float(std::uint32_t, std::uint32_t)>& value) {
    FloatImage image(kWidth, kHeight, 4, 0.0f);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        for (std::uint32_t c = 0; c < 3; ++c) image.at(x, y, c) = value(x, y);
      }
    }
    rtapi::UploadTexture(device_, queue_, signal_, 0, std::as_bytes(std::span(image.values)))
        .value();
    rtapi::CommandList list = device_.CreateCommandList().value();
    denoiser.dispatch(list, frame_);
    queue_.ExecuteAndWait(list).value();
    return read_picture(device_, queue_, denoiser.result()).value();
  }

  bool is_surface(std::uint32_t x, std::uint32_t y) const { return view_z_.at(x, y) > 0; }
  bool is_sphere(std::uint32_t x, std::uint32_t y) const { return ids_.at(x, y, 0) == 2.0f; }

  // Over the surface pixels of a picture's first channel.
  template <class F>
  void for_surface(F visit) const {
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        if (is_surface(x, y)) visit(x, y);
      }
    }
  }

  Scene scene_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  GpuScene gpu_;
  Frame frame_;
  RayPass gbuffer_;
  rtapi::Texture signal_;
  FloatImage view_z_, ids_, position_;
};

const DenoiseMethod kAll[] = {DenoiseMethod::kNone,      DenoiseMethod::kGaussian,
                              DenoiseMethod::kBilateral, DenoiseMethod::kBilateralExact,
                              DenoiseMethod::kTemporal,  DenoiseMethod::kSvgf};

TEST_F(DenoiseTest, ConstantsStay) {
  for (const DenoiseMethod method : kAll) {
    Denoiser denoiser = make(default_denoise(method));
    for (int frame = 0; frame < 3; ++frame) {
      const FloatImage out = run(denoiser, [](auto, auto) { return 0.7f; });
      double worst = 0;
      for_surface([&](auto x, auto y) { worst = std::max(worst, std::abs(out.at(x, y) - 0.7)); });
      EXPECT_LT(worst, 2e-6) << static_cast<int>(method) << " frame " << frame;
    }
  }
}

TEST_F(DenoiseTest, WhatIsNotFiniteStaysInItsPixelAndGoes) {
  for (const DenoiseMethod method : kAll) {
    if (method == DenoiseMethod::kNone) continue;
    Denoiser denoiser = make(default_denoise(method));
    run(denoiser, [](auto, auto) { return 0.5f; });
    FloatImage out = run(denoiser, [](auto x, auto y) {
      if (x % 9 != 4 || y % 9 != 4) return 0.5f;
      return x % 2 == 0 ? std::numeric_limits<float>::quiet_NaN()
                        : std::numeric_limits<float>::infinity();
    });
    for (const float value : out.values) ASSERT_TRUE(std::isfinite(value));
    for (int i = 0; i < 40; ++i) out = run(denoiser, [](auto, auto) { return 0.5f; });
    for_surface([&](auto x, auto y) { ASSERT_NEAR(out.at(x, y), 0.5, 0.02) << x << "," << y; });
  }
}

// A bright sphere before a dark plane: what does a method carry over the silhouette?
TEST_F(DenoiseTest, GuidesStopTheLightAtSilhouettes) {
  const auto leak = [&](DenoiseMethod method) {
    Denoiser denoiser = make(default_denoise(method));
    const auto value = [&](auto x, auto y) { return is_sphere(x, y) ? 1.0f : 0.0f; };
    const FloatImage out = run(denoiser, value);
    double sum = 0;
    for_surface([&](auto x, auto y) { sum += std::abs(out.at(x, y) - value(x, y)); });
    return sum;
  };
  const double gaussian = leak(DenoiseMethod::kGaussian);
  EXPECT_GT(gaussian, 20);
  EXPECT_LT(leak(DenoiseMethod::kBilateral), 0.05 * gaussian);
  EXPECT_LT(leak(DenoiseMethod::kBilateralExact), 0.05 * gaussian);
  EXPECT_LT(leak(DenoiseMethod::kSvgf), 0.05 * gaussian);
}

TEST_F(DenoiseTest, SeparableIsCloseToExact) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform;
  FloatImage noise(kWidth, kHeight, 1);
  for (float& value : noise.values) value = uniform(random);
  const auto value = [&](auto x, auto y) { return noise.at(x, y); };
  Denoiser rows = make(default_denoise(DenoiseMethod::kBilateral));
  Denoiser exact = make(default_denoise(DenoiseMethod::kBilateralExact));
  const FloatImage a = run(rows, value), b = run(exact, value);
  double squares = 0, count = 0;
  for_surface([&](auto x, auto y) {
    squares += std::pow(a.at(x, y) - b.at(x, y), 2);
    ++count;
  });
  EXPECT_LT(std::sqrt(squares / count), 0.02);
}

// The weights of the first frames are 1 / N: an average of N frames.
TEST_F(DenoiseTest, AccumulationAveragesFrames) {
  DenoiseDesc desc = default_denoise(DenoiseMethod::kTemporal);
  desc.constants.clip_gamma = 0;
  Denoiser denoiser = make(desc);
  std::mt19937 random(5);
  std::normal_distribution<float> noise(1.0f, 0.3f);
  FloatImage out;
  for (int i = 0; i < 16; ++i) out = run(denoiser, [&](auto, auto) { return noise(random); });
  double squares = 0, count = 0;
  for_surface([&](auto x, auto y) {
    squares += std::pow(out.at(x, y) - 1, 2);
    ++count;
  });
  EXPECT_NEAR(squares / count, 0.09 / 16, 0.15 * 0.09 / 16);
  const FloatImage moments = read_picture(device_, queue_, denoiser.moments()).value();
  for_surface([&](auto x, auto y) { ASSERT_EQ(moments.at(x, y, 2), 16.0f); });
}

TEST_F(DenoiseTest, SvgfRemovesNoiseAndKeepsTheMean) {
  Denoiser denoiser = make(default_denoise(DenoiseMethod::kSvgf));
  std::mt19937 random(11);
  std::bernoulli_distribution open(0.4);  // one visibility ray per pixel
  FloatImage out;
  for (int i = 0; i < 8; ++i) {
    out = run(denoiser, [&](auto, auto) { return open(random) ? 1.0f : 0.0f; });
    if (i > 0) continue;
    double squares = 0, count = 0;
    for_surface([&](auto x, auto y) {
      squares += std::pow(out.at(x, y) - 0.4, 2);
      ++count;
    });
    EXPECT_LT(squares / count, 0.24 / 20);  // the first frame already
  }
  double sum = 0, squares = 0, count = 0;
  for_surface([&](auto x, auto y) {
    sum += out.at(x, y);
    squares += std::pow(out.at(x, y) - 0.4, 2);
    ++count;
  });
  EXPECT_NEAR(sum / count, 0.4, 0.01);
  EXPECT_LT(squares / count, 0.24 / 100);
}

// A pattern that hangs in the world, seen by a camera that turns: history follows it, and is given
// up where the sphere uncovers the plane or the picture's border brings something new.
TEST_F(DenoiseTest, HistoryFollowsTheCamera) {
  DenoiseDesc desc = default_denoise(DenoiseMethod::kTemporal);
  desc.constants.clip_gamma = 0;
  Denoiser denoiser = make(desc);
  const auto pattern = [&](auto x, auto y) {
    // Fades with the distance: at the horizon it would be finer than a pixel.
    const float z = view_z_.at(x, y);
    return 0.5f + 0.4f * std::sin(2 * position_.at(x, y, 0)) * std::exp(-z * z / 50);
  };
  Camera camera = scene_.cameras.front();
  Camera before = camera;
  FloatImage out;
  for (std::uint32_t i = 0; i < 8; ++i) {
    if (i > 0) {
      const double angle = 0.02;  // about the world's vertical axis, two pixels or so
      const glm::dmat3 turn(std::cos(angle), 0, -std::sin(angle), 0, 1, 0, std::sin(angle), 0,
                            std::cos(angle));
      for (int axis = 0; axis < 3; ++axis) {
        camera.camera_to_world[axis] =
            glm::dvec4(turn * glm::dvec3(camera.camera_to_world[axis]), 0.0);
      }
      frame_.set_camera(device_, scene_, camera, {.index = i, .previous_camera = before}).value();
      render_gbuffer();
      before = camera;
    }
    out = run(denoiser, pattern);
  }
  const FloatImage moments = read_picture(device_, queue_, denoiser.moments()).value();
  double squares = 0, count = 0, kept = 0;
  for_surface([&](auto x, auto y) {
    squares += std::pow(out.at(x, y) - pattern(x, y), 2);
    ++count;
    if (moments.at(x, y, 2) == 8.0f) ++kept;
  });
  EXPECT_LT(std::sqrt(squares / count), 0.02);  // a still history would be 0.04 off
  EXPECT_GT(kept / count, 0.6);
  EXPECT_LT(kept / count, 0.95);  // one border is new
}

TEST_F(DenoiseTest, MotionThatIsWildIsNoHistory) {
  Denoiser denoiser = make(default_denoise(DenoiseMethod::kSvgf));
  run(denoiser, [](auto, auto) { return 0.1f; });
  FloatImage motion(kWidth, kHeight, 4, 1e9f);
  motion.values[0] = std::numeric_limits<float>::quiet_NaN();
  rtapi::UploadTexture(device_, queue_, frame_.texture(kMotion), 0,
                       std::as_bytes(std::span(motion.values)))
      .value();
  const FloatImage out = run(denoiser, [](auto, auto) { return 0.9f; });
  for_surface([&](auto x, auto y) { ASSERT_NEAR(out.at(x, y), 0.9, 1e-5); });
}

}  // namespace
}  // namespace kaamos::effects
