// SPDX-License-Identifier: MIT
//
// frame/...: the whole frame of the lounge against its rays alone, and SVGF against the same filter
// written by hand.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>

#include "effects/denoise/denoise.h"
#include "effects/engine/picture.h"
#include "fixtures.h"
#include "frame_run.h"
#include "scalar_svgf.h"

namespace kaamos::bench {
namespace {

// The frame's rays and a plain Embree scene for them.
struct Rays {
  std::vector<FrameRay> rays;
  SceneData data;
  EmbreeScene scene;

  // Records the rays of the whole frame, or of one part of it.
  explicit Rays(FrameRun& run, const std::string& part = "")
      : data(run.scene_at_camera()), scene(data, true) {
    run.trace_and_shade();  // so that shadow maps and history are as in any later frame
    rays = run.record(hits_, part);
  }
  void trace(Fixtures& fixtures) const {
    const auto found = static_cast<double>(scene.trace(fixtures.arena(), rays));
    const auto expected = static_cast<double>(hits_);
    if (std::fabs(found - expected) > 1e-3 * expected + 8) {
      throw std::runtime_error("results differ: the frame's rays hit " + std::to_string(hits_) +
                               " times, the baseline's " + std::to_string(found));
    }
  }

 private:
  uint64_t hits_ = 0;
};

Line compare_frame(const char* name, Fixtures& fixtures, const Measure& measure, bool whole) {
  FrameRun& run = fixtures.frame_run();
  const Rays rays(run);
  // As in the middle of a sequence: the filters have their history.
  for (uint32_t frame = 0; whole && frame < effects::kFramesOfHistory; ++frame) {
    run.trace_and_shade();
    run.denoise_and_compose();
  }
  const Pairs times = time_pairs(
      measure,
      [&] {
        run.trace_and_shade();
        if (whole) run.denoise_and_compose();
      },
      [&] { rays.trace(fixtures); });
  return {name, times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

Line trace_shade(Fixtures& fixtures, const Measure& measure) {
  return compare_frame("frame/trace-shade", fixtures, measure, false);
}

Line trace_shade_part(const std::string& part, Fixtures& fixtures, const Measure& measure) {
  FrameRun& run = fixtures.frame_run();
  const Rays rays(run, part);
  const Pairs times = time_pairs(
      measure, [&] { run.trace_and_shade(part); }, [&] { rays.trace(fixtures); });
  return {"frame/part/" + part, times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

Line all(Fixtures& fixtures, const Measure& measure) {
  return compare_frame("frame/all", fixtures, measure, true);
}

void check_same(const effects::FloatImage& ours, const std::vector<Float4>& baseline) {
  double squares = 0;
  double energy = 0;
  for (size_t i = 0; i < baseline.size(); ++i) {
    const float expected[3] = {baseline[i].x, baseline[i].y, baseline[i].z};
    for (size_t c = 0; c < 3; ++c) {
      const double difference = ours.values[4 * i + c] - expected[c];
      squares += difference * difference;
      energy += double{expected[c]} * expected[c];
    }
  }
  if (!(squares <= 1e-10 * energy)) {
    throw std::runtime_error("results differ: the relative error of the pictures is " +
                             std::to_string(std::sqrt(squares / energy)));
  }
}

// A cut and the frame after it: variance over pixels and over time, with and without history.
constexpr int kFrames = 2;

Line svgf(Fixtures& fixtures, const Measure& measure) {
  FrameRun& run = fixtures.frame_run();
  run.trace_and_shade();
  const SvgfInput input = svgf_input(run.device(), run.queue(), run.frame(), run.sum("ao"));
  const rtapi::Texture signal =
      run.frame().create_picture(run.device(), "signal", rtapi::Format::kR32G32B32A32Float).value();
  rtapi::UploadTexture(run.device(), run.queue(), signal, 0, std::as_bytes(std::span(input.signal)))
      .value();
  const effects::DenoiseDesc desc = effects::default_denoise(effects::DenoiseMethod::kSvgf);
  effects::Denoiser denoiser =
      effects::Denoiser::create(run.device(), run.frame(), effects::denoise_libraries().value(),
                                "bench", signal, desc)
          .value();
  ScalarSvgf scalar(input.width, input.height, desc);
  const Pairs times = time_pairs(
      measure,
      [&] {
        denoiser.reset();
        rtapi::CommandList list = run.device().CreateCommandList().value();
        for (int i = 0; i < kFrames; ++i) denoiser.dispatch(list, run.frame());
        run.queue().ExecuteAndWait(list).value();
      },
      [&] {
        scalar.reset();
        for (int i = 0; i < kFrames; ++i) scalar.run(fixtures.arena(), input);
      });
  check_same(effects::read_picture(run.device(), run.queue(), denoiser.result()).value(),
             scalar.result());
  return {"frame/svgf", times.ratio, 1e3 * times.ours / kFrames, 1e3 * times.baseline / kFrames,
          "ms",         false};
}

}  // namespace

std::vector<Case> frame_cases() {
  std::vector<Case> cases = {
      {"frame/svgf", svgf}, {"frame/trace-shade", trace_shade}, {"frame/all", all}};
  for (const std::string part : kFrameParts) {
    cases.push_back({"frame/part/" + part, [part](Fixtures& fixtures, const Measure& measure) {
                       return trace_shade_part(part, fixtures, measure);
                     }});
  }
  return cases;
}

}  // namespace kaamos::bench
