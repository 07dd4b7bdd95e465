// SPDX-License-Identifier: MIT
// A-SVGF: what is still has no gradients at all, what changes is forgotten at once. On both
// backends. [Schied et al. 2018]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "effects/denoise/stage_fixture.h"
#include "effects/denoise/temporal_gradients.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 48, kHeight = 36;

double mean(const FloatImage& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.values.size(); i += image.channels) sum += image.values[i];
  return sum * image.channels / static_cast<double>(image.values.size());
}

double largest(const FloatImage& image, std::uint32_t channels = 3) {
  double out = 0;
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    if (i % image.channels < channels) out = std::max(out, double{image.values[i]});
  }
  return out;
}

class TemporalGradientsTest : public test::OnBackends {};

// Channels of the changes, in the order of the registry.
constexpr std::uint32_t kAo = 0, kSun = 1, kIndirect = 2;

// The same samples of the same scene are the same to the last bit. Where a light goes out, nothing
// is as it was. One body, because most of the time goes into the software driver's pipelines.
TEST_P(TemporalGradientsTest, OnlyWhatChangesHasGradients) {
  Scene scene = make_stage();
  Show show(scene, {DenoiseMethod::kAdaptiveSvgf, GetParam(), {"ao", "sun", "gi"}});
  for (int i = 0; i < 3; ++i) show.render();
  EXPECT_GT(mean(show.read("ao")), 0.1);
  EXPECT_GT(mean(show.read("sun")), 0.1);
  const FloatImage before = show.read("indirect");
  EXPECT_GT(mean(before), 0.01);
  EXPECT_EQ(largest(show.changes()), 0.0) << "still";

  scene.lights[0].intensity = 0;
  scene.sun->irradiance = glm::vec3(0);
  show.render();
  const FloatImage changes = show.changes();
  ASSERT_LT(largest(show.read("indirect")), 1e-6);
  std::uint32_t whole = 0, lit = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      EXPECT_EQ(changes.at(x, y, kAo), 0.0f);
      EXPECT_EQ(changes.at(x, y, kSun), 0.0f) << "visibility is not light";
      const float change = changes.at(x, y, kIndirect);
      EXPECT_TRUE(change == 1.0f || change == 0.0f) << "all or nothing";
      if (change == 1.0f) ++whole;
      if (before.at(x, y) > 0) ++lit;
    }
  }
  EXPECT_GT(lit, 200u);
  EXPECT_GE(whole, lit) << "filtered, changes reach beyond what happened to be lit";

  // A camera that moves rounds positions differently; hardly any ray goes another way.
  for (int i = 0; i < 3; ++i) show.render(0, {0.03 * i, 0, 0.01 * i});
  EXPECT_LT(mean(show.changes()), 0.01);
}

// Returns how many frames after the change a signal needs for nine tenths of the way from `before`
// to `after`.
template <class Value>
int lag(Value value, double before, double after) {
  for (int frame = 1; frame <= 40; ++frame) {
    if (std::abs(value() - after) <= 0.1 * std::abs(before - after)) return frame;
  }
  return 41;
}

int lag_of_light(DenoiseMethod method) {
  Scene scene = make_stage();
  Show show(scene, {method, "embree", {"gi"}});
  for (int i = 0; i < 12; ++i) show.render();
  const double before = mean(show.read("indirect_denoised"));
  scene.lights[0].intensity = 0;
  scene.sun->irradiance = glm::vec3(0);
  const auto value = [&] {
    show.render();
    return mean(show.read("indirect_denoised"));
  };
  return lag(value, before, 0);
}

TEST(TemporalGradients, ALightGoesOutWithoutLag) {
  const int svgf = lag_of_light(DenoiseMethod::kSvgf);
  const int adaptive = lag_of_light(DenoiseMethod::kAdaptiveSvgf);
  std::printf("frames to nine tenths: svgf %d, a-svgf %d\n", svgf, adaptive);
  EXPECT_LE(adaptive, 2);
  EXPECT_GE(svgf, 8);
}

// The floor beside the board, in its shadow: the middle of the picture.
double mean_of_centre(const FloatImage& image) {
  double sum = 0, count = 0;
  for (std::uint32_t y = image.height * 5 / 12; y < image.height * 7 / 12; ++y) {
    for (std::uint32_t x = image.width * 5 / 12; x < image.width * 7 / 12; ++x, ++count) {
      sum += image.at(x, y);
    }
  }
  return sum / count;
}

// Both filters over the same frames, of a signal that has a place among the changes.
struct Lags {
  int svgf = 0, adaptive = 0;
};

Lags lags_of_occluder(const std::string& effect, std::uint32_t channel) {
  Scene scene = make_stage();
  Show show(scene, {DenoiseMethod::kAdaptiveSvgf, "embree", {effect}, 96, 72});
  show.render();
  FrameRenderer& renderer = show.renderer();
  const DenoiseLibraries libraries = denoise_libraries().value();
  const rtapi::Texture signal =
      renderer.frame()
          .create_picture(renderer.device(), "signal", rtapi::Format::kR32G32B32A32Float)
          .value();
  std::vector<Denoiser> denoisers;
  for (const DenoiseMethod method : {DenoiseMethod::kSvgf, DenoiseMethod::kAdaptiveSvgf}) {
    denoisers.push_back(
        Denoiser::create(renderer.device(), renderer.frame(), libraries,
                         {{"test",
                           signal,
                           false,
                           {renderer.effects().gradients().gradients()->changes(), channel}}},
                         default_denoise(method))
            .value());
    denoisers.back()
        .create_load(renderer.device(), renderer.frame(), libraries, renderer.effects().sum(effect))
        .value();
  }
  const auto render = [&](double seconds) {
    show.render(seconds);
    std::vector<double> out;
    for (Denoiser& denoiser : denoisers) {
      renderer.runner()
          .execute([&](rtapi::CommandList& list) {
            denoiser.load(list, renderer.frame(), 1);
            denoiser.dispatch(list, renderer.frame());
          })
          .value();
      out.push_back(mean_of_centre(renderer.read(denoiser.result()).value()));
    }
    return out;
  };
  std::vector<double> before, after;
  for (int i = 0; i < 16; ++i) before = render(0);
  std::vector<std::vector<double>> frames;
  for (int i = 0; i < 40; ++i) frames.push_back(render(3));
  const auto lag_of = [&](std::size_t i) {
    const double end = frames.back()[i];
    EXPECT_GT(std::abs(end - before[i]), 0.1);
    std::size_t frame = 0;
    return lag([&] { return frames.at(frame++)[i]; }, before[i], end);
  };
  return {lag_of(0), lag_of(1)};
}

TEST(TemporalGradients, AnOccluderLeavesWithoutLag) {
  const Lags sun = lags_of_occluder("sun", 0);
  std::printf("sun, frames to nine tenths: svgf %d, a-svgf %d\n", sun.svgf, sun.adaptive);
  EXPECT_LE(sun.adaptive, 2);
  EXPECT_GE(sun.svgf, 8);
  // A signal that changes in part is forgotten in part: only a sixth of the light is new.
  const Lags ao = lags_of_occluder("ao", 0);
  std::printf("ao, frames to nine tenths: svgf %d, a-svgf %d\n", ao.svgf, ao.adaptive);
  EXPECT_LE(ao.adaptive, ao.svgf);
}

TEST(TemporalGradients, MoreSignalsThanChannelsAreRefused) {
  Scene scene = make_stage();
  Show show(scene, {DenoiseMethod::kAdaptiveSvgf, "embree", {"ao"}});
  show.render();
  FrameRenderer& renderer = show.renderer();
  TemporalGradients gradients =
      TemporalGradients::create(renderer.device(), renderer.frame(), renderer.context().gpu,
                                denoise_libraries().value())
          .value();
  const rtapi::Texture sum = renderer.effects().sum("ao");
  for (std::size_t i = 0; i < kMostGradients; ++i) {
    EXPECT_EQ(gradients.add(renderer.device(), renderer.frame(), sum, sum).value(), i);
  }
  const auto refused = gradients.add(renderer.device(), renderer.frame(), sum, sum);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "KA3091 temporal gradients cannot be made: 5 signals whose samples are taken again: 4 "
            "are allowed");
}

INSTANTIATE_TEST_SUITE_P(Backends, TemporalGradientsTest, testing::Values("embree", "vulkan"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace kaamos::effects
