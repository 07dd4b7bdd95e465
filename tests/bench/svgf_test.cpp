// SPDX-License-Identifier: MIT
// The baseline of frame/svgf is the same filter: same pictures, frame after frame, in motion too.
#include <gtest/gtest.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "effects/engine/picture.h"
#include "frame_run.h"
#include "scalar_svgf.h"

namespace kaamos::bench {
namespace {

constexpr uint32_t kWidth = 97, kHeight = 55;

TEST(ScalarSvgf, GivesThePicturesOfTheShaders) {
  FrameRun run(kWidth, kHeight, 2);
  run.trace_and_shade();
  const rtapi::Device& device = run.device();
  const effects::Frame& frame = run.frame();
  const rtapi::Texture signal =
      frame.create_picture(device, "signal", rtapi::Format::kR32G32B32A32Float).value();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  // Two pixels to each side, and some that come from outside the picture.
  effects::FloatImage motion(kWidth, kHeight, 4, 0.0f);
  for (size_t i = 0; i < motion.values.size(); i += 4) {
    motion.values[i] = 2 * uniform(random) / kWidth;
    motion.values[i + 1] = i % 40 == 0 ? 1e9f : 2 * uniform(random) / kHeight;
  }
  rtapi::UploadTexture(device, run.queue(), frame.texture(effects::kMotion), 0,
                       std::as_bytes(std::span(motion.values)))
      .value();
  for (const auto& [clip, keeps_energy] :
       {std::pair(0.0f, true), std::pair(1.5f, false), std::pair(1.5f, true)}) {
    effects::DenoiseDesc desc = effects::default_denoise(effects::DenoiseMethod::kSvgf);
    desc.constants.clip_gamma = clip;
    desc.constants.keep_energy = keeps_energy ? 1 : 0;
    effects::Denoiser denoiser =
        effects::Denoiser::create(device, frame, effects::denoise_libraries().value(), "test",
                                  signal, desc)
            .value();
    ScalarSvgf scalar(kWidth, kHeight, desc);
    tbb::task_arena arena(2);
    SvgfInput input = svgf_input(device, run.queue(), frame, signal);
    for (int index = 0; index < 6; ++index) {
      for (Float4& light : input.signal) {
        light = {uniform(random) > 0 ? 1.0f : 0.0f, uniform(random) + 1, 0.5f, 0};
      }
      rtapi::UploadTexture(device, run.queue(), signal, 0, std::as_bytes(std::span(input.signal)))
          .value();
      rtapi::CommandList list = device.CreateCommandList().value();
      denoiser.dispatch(list, frame);
      run.queue().ExecuteAndWait(list).value();
      scalar.run(arena, input);
      const auto ours = effects::read_picture(device, run.queue(), denoiser.result()).value();
      double worst = 0;
      for (size_t i = 0; i < scalar.result().size(); ++i) {
        const Float4& expected = scalar.result()[i];
        worst = std::max({worst, std::abs(double{ours.values[4 * i]} - expected.x),
                          std::abs(double{ours.values[4 * i + 1]} - expected.y),
                          std::abs(double{ours.values[4 * i + 2]} - expected.z)});
      }
      EXPECT_LT(worst, 1e-4) << "frame " << index << ", clipped to " << clip
                             << (keeps_energy ? ", with its energy" : "");
    }
  }
}

}  // namespace
}  // namespace kaamos::bench
