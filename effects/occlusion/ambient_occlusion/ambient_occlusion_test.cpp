// SPDX-License-Identifier: MIT
// Uniform and cosine-distributed rays find the same openness; how much noisier the former are.
// [survey 7.4; effects/SOURCES.md: E4]
#include "effects/occlusion/ambient_occlusion/ambient_occlusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "effects/assets/built_in/crown.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/common/sobol.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/on_backends.h"

namespace kaamos::effects {
namespace {

constexpr double kPi = 3.14159265358979;

std::unique_ptr<FrameRenderer> both_ways(const Scene& scene, const std::string& backend = "embree",
                                         std::uint32_t width = 32, std::uint32_t height = 18) {
  FrameSettings settings;
  settings.width = width;
  settings.height = height;
  settings.effects = choose_effects({"ao", "ao-uniform"});
  settings.denoise = default_denoise(DenoiseMethod::kNone);
  rtapi::DeviceDesc device;
  device.Backend = backend;
  auto out = FrameRenderer::create(test::device_for(device), scene, settings).value();
  out->render().value();
  return out;
}

EffectSettings rays(std::uint32_t count, float radius, std::uint32_t survey_rule = 0) {
  EffectSettings settings{.samples = count, .radius = radius};
  return settings.set_constants(UniformOcclusionConstants{survey_rule});
}

// The first channel.
FloatImage found(FrameRenderer& renderer, const std::string& effect,
                 const EffectSettings& settings) {
  renderer.run(effect, settings).value();
  const FloatImage picture = renderer.read(effect == "ao" ? "ao" : "ao_uniform").value();
  FloatImage out(picture.width, picture.height, 1);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = picture.values[i * picture.channels];
  }
  return out;
}

class AmbientOcclusionTest : public test::OnBackends {};

// Below a sphere, against the closed form. What the survey sums lacks the density.
TEST_P(AmbientOcclusionTest, UniformRaysAgreeWithTheClosedForm) {
  const Scene scene = make_sphere_oracle(0.5, 0.8);
  const auto renderer = both_ways(scene, GetParam());
  constexpr std::uint32_t kRays = 128;
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const FloatImage uniform = found(*renderer, "ao-uniform", rays(kRays, kFar));
  const FloatImage cosine = found(*renderer, "ao", rays(kRays, kFar));
  const FloatImage survey = found(*renderer, "ao-uniform", rays(kRays, kFar, 1));
  const FloatImage ids = renderer->read("ids").value();
  const FloatImage position = renderer->read("position").value();
  const glm::dvec3 eye = scene.cameras.front().position();
  double off = 0, apart = 0, open = 0, open_survey = 0;
  int count = 0, most_open = 0;
  for (std::size_t i = 0; i < uniform.values.size(); ++i) {
    if (ids.values[2 * i] == 0) {
      EXPECT_EQ(uniform.values[i], 1) << "the sky";
      continue;
    }
    if (ids.values[2 * i] != 1) continue;
    const double truth = 1 - sphere_occlusion(0.5, 0.8,
                                              std::hypot(eye.x + position.values[4 * i],
                                                         eye.z + position.values[4 * i + 2]));
    off += std::pow(uniform.values[i] - truth, 2);
    apart += uniform.values[i] - cosine.values[i];
    EXPECT_NEAR(survey.values[i], uniform.values[i] / (2 * kPi), 1e-4);
    ++count;
    if (truth < 0.98) continue;
    open += uniform.values[i] / truth;
    open_survey += survey.values[i] / truth;
    ++most_open;
  }
  ASSERT_GT(count, 100);
  ASSERT_GT(most_open, 20);
  std::printf("%d pixels: RMSE %.5f, uniform - cosine %.6f, open plane %.4f, survey's %.4f\n",
              count, std::sqrt(off / count), apart / count, open / most_open,
              open_survey / most_open);
  // 128 independent rays of a standard deviation of 0.58 would be off by 0.051.
  EXPECT_LT(std::sqrt(off / count), 0.051);
  EXPECT_LT(std::abs(apart / count), 0.002);
  EXPECT_NEAR(open / most_open, 1, 0.005);
  EXPECT_NEAR(open_survey / most_open, 0.159, 0.001);
}

// No radius: nothing is in the way. Sums go on.
TEST_P(AmbientOcclusionTest, UniformRaysOfNoLengthSeeNothing) {
  const auto renderer = both_ways(make_sphere_oracle(0.5, 0.8), GetParam(), 16, 9);
  for (const float v : found(*renderer, "ao-uniform", rays(4, 0)).values) ASSERT_EQ(v, 1);
  renderer->accumulate("ao-uniform", rays(64, 0.3f), {}).value();
  const FloatImage in_parts = renderer->read("ao_uniform").value();
  const FloatImage at_once = found(*renderer, "ao-uniform", rays(64, 0.3f));
  for (std::size_t i = 0; i < at_once.values.size(); ++i) {
    ASSERT_NEAR(in_parts.values[4 * i], at_once.values[i], 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, AmbientOcclusionTest, testing::Values("embree", "vulkan"),
                         [](const auto& backend) { return backend.param; });

// A wedge leaves a share p of all directions about the normal open, at every height alike: the
// variances of independent rays.
TEST(UniformOcclusion, VarianceBehindAWedge) {
  constexpr std::uint32_t kPoints = 1u << 16;
  for (const double p : {0.25, 0.5, 2.0 / 3, 0.9}) {
    double uniform[2] = {}, cosine[2] = {};
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      const glm::dvec2 u = sobol_owen(i, 5);
      const double open = u.y < p ? 1 : 0;
      uniform[0] += 2 * u.x * open / kPoints;
      uniform[1] += 4 * u.x * u.x * open / kPoints;
      cosine[0] += open / kPoints;
      cosine[1] += open * open / kPoints;
    }
    EXPECT_NEAR(uniform[0], p, 1e-3);
    EXPECT_NEAR(cosine[0], p, 1e-3);
    const double ratio =
        (uniform[1] - uniform[0] * uniform[0]) / (cosine[1] - cosine[0] * cosine[0]);
    EXPECT_NEAR(ratio, (4 * p / 3 - p * p) / (p - p * p), 0.01 * ratio) << p;
    if (p > 0.6 && p < 0.7) {
      EXPECT_NEAR(ratio, 2, 0.01);
    }
  }
}

// The crown, as in the survey's figure: 8 uniform rays are about as noisy as 4 cosine-distributed
// ones. Over pixels that are neither open nor closed.
TEST(UniformOcclusion, EightRaysAreAsNoisyAsFourByTheCosine) {
  const auto renderer = both_ways(make_crown(), "embree", 48, 27);
  const FloatImage truth = found(*renderer, "ao", rays(1024, 4));
  double sums[3] = {};
  const struct {
    const char* effect;
    std::uint32_t rays;
  } runs[] = {{"ao", 4}, {"ao-uniform", 4}, {"ao-uniform", 8}};
  constexpr std::uint32_t kSeeds = 16;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    ASSERT_TRUE(renderer->set_seed(seed));
    for (int k = 0; k < 3; ++k) {
      const FloatImage noisy = found(*renderer, runs[k].effect, rays(runs[k].rays, 4));
      for (std::size_t i = 0; i < truth.values.size(); ++i) {
        if (truth.values[i] < 0.2 || truth.values[i] > 0.9) continue;
        sums[k] += std::pow(noisy.values[i] - truth.values[i], 2);
      }
    }
  }
  std::printf("variance over that of 4 cosine rays: 4 uniform %.3f, 8 uniform %.3f\n",
              sums[1] / sums[0], sums[2] / sums[0]);
  EXPECT_GT(sums[1] / sums[0], 1.4);
  EXPECT_NEAR(sums[2] / sums[0], 1, 0.35);
}

}  // namespace
}  // namespace kaamos::effects
