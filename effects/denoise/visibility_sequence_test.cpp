// SPDX-License-Identifier: MIT
// A scene's own sun: denoised visibility is never worse than raw, at rest and in motion. On both
// backends.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "effects/assets/built_in/runner.h"
#include "effects/composition/taa/sequence_fixture.h"
#include "effects/denoise/sum_load.h"
#include "effects/denoise/visibility_denoiser.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 60;
constexpr std::uint32_t kRays = 2;

// A denoiser of the sun's visibility as a frame has it.
class SunFilter {
 public:
  SunFilter(SequenceStage& stage, DenoiseMethod method) {
    const DenoiseLibraries libraries = denoise_libraries().value();
    const auto picture = [&](const char* name) {
      return stage.frame.create_picture(stage.device, name, rtapi::Format::kR32G32B32A32Float)
          .value();
    };
    const rtapi::Texture mean = picture("mean"), sharpness = picture("sharpness");
    const auto load = [&](const rtapi::Texture& sum, const rtapi::Texture& into) {
      return SumLoad::create(stage.device, stage.frame, libraries, sum, into).value();
    };
    loads_ = {load(stage.sun_sums.visible, mean), load(stage.sun_sums.sharpness, sharpness)};
    denoiser_ = VisibilityDenoiser::create(stage.device, stage.frame, libraries,
                                           {{"sun", 1, mean, sharpness, {}}}, method)
                    .value();
  }
  FloatImage run(SequenceStage& stage) {
    stage.run([&](rtapi::CommandList& list) {
      for (const SumLoad& load : loads_) load.record(list, stage.frame, 1.0f / kRays);
      denoiser_.dispatch(list, stage.frame);
    });
    return stage.read(denoiser_.result());
  }

 private:
  std::vector<SumLoad> loads_;
  VisibilityDenoiser denoiser_;
};

// Returns what the sun's visibility converges to in the current frame.
FloatImage converged(SequenceStage& stage) {
  constexpr std::uint32_t kSamples = 256;
  stage.run([&](rtapi::CommandList& list) {
    PassConstants constants;
    constants.first_sample = 1000;
    constants.sample_count = kSamples;
    constants.accumulate = 0;
    stage.sun.dispatch(list, stage.frame, constants, stage.frame.height(),
                       stage.sun_sums.arguments());
  });
  FloatImage out = stage.read(stage.sun_sums.visible);
  for (float& value : out.values) value /= kSamples;
  return out;
}

double rmse(const FloatImage& image, const FloatImage& reference) {
  double squares = 0;
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    squares += std::pow(image.values[i * image.channels] - reference.values[i], 2);
  }
  return std::sqrt(squares / static_cast<double>(reference.values.size()));
}

class VisibilitySequence : public testing::TestWithParam<const char*> {};

TEST_P(VisibilitySequence, DenoisedSunIsNeverWorseThanRaw) {
  for (const bool moves : {false, true}) {
    Scene scene = make_runner_scene({.crowd = 3});
    scene.sun->angular_radius = 0.03f;  // penumbras of several pixels beside sharp ones
    SequenceStage stage(scene, kWidth, kHeight, 0, GetParam());
    const DenoiseMethod methods[] = {DenoiseMethod::kTemporal, DenoiseMethod::kSvgf,
                                     DenoiseMethod::kControl};
    std::vector<SunFilter> filters;
    for (const DenoiseMethod method : methods) filters.emplace_back(stage, method);
    for (int frame = 0; frame < 8; ++frame) {
      stage.begin(moves ? frame / 30.0 : 0);
      stage.light(kRays);
      FloatImage raw = stage.read(stage.sun_sums.visible);
      for (float& value : raw.values) value /= kRays;
      std::vector<FloatImage> filtered;
      for (SunFilter& filter : filters) filtered.push_back(filter.run(stage));
      if (frame != 0 && frame != 7) continue;
      const FloatImage truth = converged(stage);
      const double raw_error = rmse(raw, truth);
      ASSERT_GT(raw_error, 0.01);
      for (std::size_t i = 0; i < filtered.size(); ++i) {
        const double error = rmse(filtered[i], truth);
        const std::string what = "method " + std::to_string(static_cast<int>(methods[i])) +
                                 ", frame " + std::to_string(frame) +
                                 (moves ? " in motion" : " at rest");
        EXPECT_LT(error, raw_error + 0.002) << what;
        if (frame == 7 && !moves) {
          EXPECT_LT(error, 0.5 * raw_error) << what;
        }
      }
    }
  }
}

std::vector<const char*> backends() {
  std::vector<const char*> out = {"embree"};
  if (test::why_no_vulkan().empty() || test::vulkan_is_required()) out.push_back("vulkan");
  return out;
}

INSTANTIATE_TEST_SUITE_P(Backends, VisibilitySequence, testing::ValuesIn(backends()),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace kaamos::effects
