// SPDX-License-Identifier: MIT
// Tests what each method preserves and what it loses, on known signals.
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "effects/assets/image/metrics.h"
#include "effects/denoise/denoise_fixture.h"

namespace kaamos::effects {
namespace {

class DenoiseTest : public DenoiseFixture {};

const DenoiseMethod kAll[] = {DenoiseMethod::kNone,      DenoiseMethod::kGaussian,
                              DenoiseMethod::kBilateral, DenoiseMethod::kBilateralExact,
                              DenoiseMethod::kTemporal,  DenoiseMethod::kSvgf,
                              DenoiseMethod::kControl};

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

// A bright sphere in front of a dark plane: how much light leaks across the silhouette?
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
  EXPECT_LT(leak(DenoiseMethod::kControl), 0.05 * gaussian);
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

// The first frames have weights 1 / N, which gives the average of N frames.
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
    EXPECT_LT(squares / count, 0.24 / 20);  // already in the first frame
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

// Pixels with few frames of history get the wide filter; after four frames the narrow one is
// enough.
TEST_F(DenoiseTest, SvgfIsNarrowerWithHistory) {
  DenoiseDesc wide = default_denoise(DenoiseMethod::kSvgf);
  wide.iterations = wide.iterations_with_history = 5;
  DenoiseDesc narrow = wide;
  narrow.iterations = narrow.iterations_with_history = 3;
  Denoiser denoiser = make(default_denoise(DenoiseMethod::kSvgf));
  Denoiser always_wide = make(wide);
  Denoiser always_narrow = make(narrow);
  std::mt19937 random(12);
  std::bernoulli_distribution open(0.4);
  for (std::uint32_t i = 0; i < kFramesOfHistory + 3; ++i) {
    FloatImage light(kWidth, kHeight, 1);
    for (float& value : light.values) value = open(random) ? 1.0f : 0.0f;
    const auto value = [&](auto x, auto y) { return light.at(x, y); };
    const FloatImage out = run(denoiser, value);
    const FloatImage five = run(always_wide, value);
    const FloatImage three = run(always_narrow, value);
    ASSERT_NE(five.values, three.values);
    ASSERT_EQ(out.values, i < kFramesOfHistory ? five.values : three.values) << "frame " << i;
  }
}

// Signals that are filtered together come out exactly as each would alone, over several frames.
TEST_F(DenoiseTest, SignalsDoNotSeeEachOther) {
  for (const auto method : {DenoiseMethod::kBilateral, DenoiseMethod::kTemporal,
                            DenoiseMethod::kSvgf, DenoiseMethod::kControl}) {
    std::vector<Denoiser::Signal> signals;
    std::vector<Denoiser> alone;
    for (std::size_t i = 0; i < kMostSignals; ++i) {
      const std::string name = "signal " + std::to_string(i);
      signals.push_back(
          {name, frame_.create_picture(device_, name, rtapi::Format::kR32G32B32A32Float).value()});
      alone.push_back(Denoiser::create(device_, frame_, denoise_libraries().value(), name,
                                       signals[i].picture, default_denoise(method))
                          .value());
    }
    Denoiser together = Denoiser::create(device_, frame_, denoise_libraries().value(), signals,
                                         default_denoise(method))
                            .value();
    std::mt19937 random(7);
    std::uniform_real_distribution<float> light(0.0f, 2.0f);
    for (int frame = 0; frame < 3; ++frame) {
      for (std::size_t i = 0; i < signals.size(); ++i) {
        FloatImage image(kWidth, kHeight, 4, 1.0f);
        for (float& value : image.values) value = static_cast<float>(i) * light(random);
        image.values[4 * (i + 200)] = std::nanf("");
        upload(signals[i].picture, image);
      }
      rtapi::CommandList list = device_.CreateCommandList().value();
      together.dispatch(list, frame_);
      for (Denoiser& denoiser : alone) denoiser.dispatch(list, frame_);
      queue_.ExecuteAndWait(list).value();
      for (std::size_t i = 0; i < signals.size(); ++i) {
        const FloatImage a = read_picture(device_, queue_, together.result(i)).value();
        const FloatImage b = read_picture(device_, queue_, alone[i].result()).value();
        EXPECT_EQ(std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)), 0)
            << static_cast<int>(method) << " frame " << frame << " signal " << i;
      }
    }
  }
}

TEST_F(DenoiseTest, TooManySignalsAreAnError) {
  for (const std::size_t count : {std::size_t{0}, kMostSignals + 1}) {
    const std::vector<Denoiser::Signal> signals(count, {"signal", signal_});
    const auto denoiser =
        Denoiser::create(device_, frame_, denoise_libraries().value(), signals, DenoiseDesc{});
    ASSERT_FALSE(denoiser);
    EXPECT_EQ(denoiser.error().message,
              "KA3043 denoiser cannot be set up: a Denoiser of " + std::to_string(count) +
                  " signals: it takes 1 to 5; make a second one for the others");
  }
}

// A pattern fixed in the world, seen by a turning camera. The history follows it, and is dropped
// where the sphere uncovers the plane or where the picture's border brings something new.
TEST_F(DenoiseTest, HistoryFollowsTheCamera) {
  DenoiseDesc desc = default_denoise(DenoiseMethod::kTemporal);
  desc.constants.clip_gamma = 0;
  Denoiser denoiser = make(desc);
  const auto pattern = [&](auto x, auto y) {
    // Fade with the distance, because near the horizon the pattern would be finer than a pixel.
    const float z = view_z_.at(x, y);
    return 0.5f + 0.4f * std::sin(2 * position_.at(x, y, 0)) * std::exp(-z * z / 50);
  };
  Camera camera = scene_.cameras.front();
  Camera before = camera;
  FloatImage out;
  for (std::uint32_t i = 0; i < 8; ++i) {
    if (i > 0) {
      const double angle = 0.02;  // about the world's vertical axis; some two pixels
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
  EXPECT_LT(std::sqrt(squares / count), 0.02);  // a history that does not move would be off by 0.04
  EXPECT_GT(kept / count, 0.6);
  EXPECT_LT(kept / count, 0.95);  // one border of the picture is new
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

// E9: the survey scales a weight by the distance in both directions with the factor of one, 1 /
// (sigma sqrt(2 pi)): all weights together are then sigma sqrt(2 pi), 5 times too bright. Ours add
// up to 1. [effects/SOURCES.md]
TEST_F(DenoiseTest, WeightsOfTheGaussianAddUpToOne) {
  const DenoiseDesc desc = default_denoise(DenoiseMethod::kGaussian);
  const double sigma = desc.constants.sigma_pixels;
  const std::int32_t radius = desc.constants.radius;
  Denoiser denoiser = make(desc);
  const FloatImage out = run(
      denoiser, [&](auto x, auto y) { return x == kWidth / 2 && y == kHeight / 2 ? 1.0f : 0.0f; });
  const auto gauss = [&](double r) { return std::exp(-r * r / (2 * sigma * sigma)); };
  double sum = 0, survey = 0, row = 0;
  for (std::int32_t i = -radius; i <= radius; ++i) row += gauss(i);
  for (std::int32_t dy = -radius; dy <= radius; ++dy) {
    for (std::int32_t dx = -radius; dx <= radius; ++dx) {
      const double found = out.at(kWidth / 2 + static_cast<std::uint32_t>(dx),
                                  kHeight / 2 + static_cast<std::uint32_t>(dy));
      ASSERT_NEAR(found, gauss(dx) * gauss(dy) / (row * row), 1e-6);
      sum += found;
      survey += gauss(std::hypot(dx, dy)) / (sigma * std::sqrt(2 * 3.14159265358979));
    }
  }
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_NEAR(survey, sigma * std::sqrt(2 * 3.14159265358979), 0.08 * survey) << "cut at 2 sigma";
  EXPECT_GT(survey, 4.5);
}

TEST_F(DenoiseTest, AFilterWithoutWidthIsNone) {
  const auto value = [](auto x, auto y) { return static_cast<float>((7 * x + 3 * y) % 5); };
  for (const DenoiseMethod method :
       {DenoiseMethod::kGaussian, DenoiseMethod::kBilateral, DenoiseMethod::kBilateralExact}) {
    for (const bool no_sigma : {true, false}) {
      DenoiseDesc desc = default_denoise(method);
      if (no_sigma) {
        desc.constants.sigma_pixels = 0;
      } else {
        desc.constants.radius = 0;
      }
      Denoiser denoiser = make(desc);
      const FloatImage out = run(denoiser, value);
      for_surface([&](auto x, auto y) { ASSERT_EQ(out.at(x, y), value(x, y)); });
    }
  }
}

TEST_F(DenoiseTest, SigmasThatAreNothingOrEverythingStayFinite) {
  float DenoiseConstants::*const sigmas[] = {&DenoiseConstants::sigma_z, &DenoiseConstants::sigma_n,
                                             &DenoiseConstants::sigma_l,
                                             &DenoiseConstants::sigma_pixels};
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform;
  for (const DenoiseMethod method : kAll) {
    for (const auto sigma : sigmas) {
      for (const float value : {0.0f, 1e30f}) {
        DenoiseDesc desc = default_denoise(method);
        desc.constants.*sigma = value;
        Denoiser denoiser = make(desc);
        for (int frame = 0; frame < 2; ++frame) {
          const FloatImage out = run(denoiser, [&](auto, auto) { return uniform(random); });
          for_surface([&](auto x, auto y) {
            ASSERT_GE(out.at(x, y), 0) << static_cast<int>(method);
            ASSERT_LE(out.at(x, y), 1.000001f) << static_cast<int>(method);
          });
        }
      }
    }
  }
}

TEST_F(DenoiseTest, HistoryThatIsBrokenOrTooLongIsLetGo) {
  for (const DenoiseMethod method :
       {DenoiseMethod::kTemporal, DenoiseMethod::kSvgf, DenoiseMethod::kControl}) {
    Denoiser denoiser = make(default_denoise(method));
    run(denoiser, [](auto, auto) { return 0.5f; });
    FloatImage moments = read_picture(device_, queue_, denoiser.moments()).value();
    for_surface([&](auto x, auto y) {
      moments.at(x, y, 2) = x % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : 255.0f;
    });
    upload(denoiser.moments(), moments);
    FloatImage out = run(denoiser, [](auto, auto) { return 0.5f; });
    for_surface([&](auto x, auto y) { ASSERT_NEAR(out.at(x, y), 0.5, 1e-5); });
    moments = read_picture(device_, queue_, denoiser.moments()).value();
    for_surface([&](auto x, auto y) {
      ASSERT_LE(moments.at(x, y, 2), 32.0f);
      ASSERT_GE(moments.at(x, y, 2), 1.0f);
    });
  }
}

TEST_F(DenoiseTest, ACutStartsAnew) {
  for (const DenoiseMethod method :
       {DenoiseMethod::kTemporal, DenoiseMethod::kSvgf, DenoiseMethod::kControl}) {
    Denoiser denoiser = make(default_denoise(method));
    for (int i = 0; i < 3; ++i) run(denoiser, [](auto, auto) { return 9.0f; });
    denoiser.reset();
    const FloatImage out = run(denoiser, [](auto, auto) { return 0.25f; });
    const FloatImage moments = read_picture(device_, queue_, denoiser.moments()).value();
    for_surface([&](auto x, auto y) {
      ASSERT_NEAR(out.at(x, y), 0.25, 1e-6);
      ASSERT_EQ(moments.at(x, y, 2), 1.0f);
    });
  }
}

TEST_F(DenoiseTest, SignalsShareTheirPipelines) {
  const DenoiseLibraries libraries = denoise_libraries().value();
  const auto pass = [&](const char* name) {
    return libraries.pipelines->get(device_, frame_, libraries.svgf, name).value();
  };
  const auto atrous = pass("Atrous");
  EXPECT_EQ(atrous, pass("Atrous"));
  EXPECT_NE(atrous, pass("EstimateVariance"));
}

// From 1 on half floats go in steps of 1/1024: a twentieth of a change of 0.008 is less than half
// of one.
TEST_F(DenoiseTest, HalfHistoryStopsShortOfSmallChanges) {
  for (const bool half : {false, true}) {
    DenoiseDesc desc = default_denoise(DenoiseMethod::kTemporal);
    desc.constants.alpha = 0.05f;
    desc.constants.max_history = 255;
    desc.constants.clip_gamma = 0;
    desc.half_history = half ? 1 : 0;
    Denoiser denoiser = make(desc);
    for (int i = 0; i < 24; ++i) run(denoiser, [](auto, auto) { return 1.0f; });
    FloatImage shown;
    for (int i = 0; i < 60; ++i) shown = run(denoiser, [](auto, auto) { return 1.008f; });
    for_surface([&](std::uint32_t x, std::uint32_t y) {
      if (half) {
        EXPECT_LT(shown.at(x, y, 0), 1.001f) << x << ", " << y;
      } else {
        EXPECT_GT(shown.at(x, y, 0), 1.007f) << x << ", " << y;
      }
    });
  }
}

}  // namespace
}  // namespace kaamos::effects
