// SPDX-License-Identifier: MIT
//
// The energy of the lounge's frame against its path-traced reference, path_traced/lounge.exr: the
// limits are those of README.md and examples/northlight/TRUTH.md. The cells of the volume of
// indirect light have 64 paths, with KAAMOS_FULL=1 the default of up to 1,024. On Embree alone:
// lavapipe takes minutes, and tests/effects/vulkan_frame_test.cpp holds that its frame of the
// lounge is Embree's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "effects/assets/built_in/lounge.h"
#include "effects/assets/image/exr.h"
#include "effects/northlight/frame_renderer.h"
#include "size.h"

namespace kaamos::test {
namespace {

using namespace effects;

constexpr std::uint32_t kFrames = 8;  // the camera rests, so that the denoiser has a history

// Red, green and blue of all pixels, or of those that show a surface.
double sum_of(const FloatImage& image, const FloatImage* ids = nullptr) {
  double sum = 0;
  for (std::size_t pixel = 0; pixel < image.values.size() / image.channels; ++pixel) {
    if (ids != nullptr && ids->values[pixel * ids->channels] == 0) continue;
    for (std::uint32_t c = 0; c < 3; ++c) sum += image.values[pixel * image.channels + c];
  }
  return sum;
}

// Light of the specular lobe over what the lobe reflects of even light, which the effect's signal
// is. Where the lobe is black, the signal stands for nothing: both are 0.
void divide_by_albedo(const FloatImage& albedo, FloatImage& signal, FloatImage& light) {
  for (std::size_t pixel = 0; pixel < albedo.values.size() / albedo.channels; ++pixel) {
    const float* by = &albedo.values[pixel * albedo.channels];
    const bool is_black = std::max({by[0], by[1], by[2]}) < 1e-3f;
    for (std::uint32_t c = 0; c < 3; ++c) {
      float& value = light.values[pixel * light.channels + c];
      value = is_black ? 0 : value / std::max(by[c], 1e-3f);
      if (is_black) signal.values[pixel * signal.channels + c] = 0;
    }
  }
}

// The frame as it is by default; at full size with all of the volume.
std::unique_ptr<FrameRenderer> render_frames(const Scene& scene, const FloatImage& size) {
  FrameSettings settings;
  settings.width = size.width;
  settings.height = size.height;
  settings.seed = 0;
  settings.effects = choose_effects({"all"});
  settings.denoise = default_denoise(DenoiseMethod::kSvgf);
  settings.volume.whole = is_full_size();
  settings.moving = true;
  auto renderer = FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    FrameMoment moment;
    moment.index = i;
    moment.camera = scene.cameras.front();
    moment.cut = i == 0;
    renderer->begin_frame(moment).value();
    renderer->render().value();
  }
  return renderer;
}

TEST(FrameEnergy, IsThatOfThePathTracedTruth) {
  const ExrFile file = read_exr(KAAMOS_SOURCE_DIR "/tests/numerics/path_traced/lounge.exr").value();
  const auto truth = [&](const std::string& layer) { return find_layer(file, layer)->image; };
  const Scene scene = make_lounge();
  const auto renderer = render_frames(scene, truth(""));
  const FloatImage ids = renderer->read("ids").value();

  const auto expect_energy = [](const char* part, double ratio, double least, double most) {
    std::printf("%-24s %.4f\n", part, ratio);
    EXPECT_GE(ratio, least) << part;
    EXPECT_LE(ratio, most) << part;
  };
  // Compares the frame composed from some signals, without emitted light, with layers of the truth.
  const double emitted = sum_of(renderer->read("emissive").value(), &ids);
  const auto part_of = [&](const std::vector<std::string>& signals,
                           const std::vector<std::string>& layers) {
    double wanted = 0;
    for (const std::string& layer : layers) wanted += sum_of(truth(layer), &ids);
    return (sum_of(read_composed(*renderer, signals).value(), &ids) - emitted) / wanted;
  };
  // The whole first: composing parts writes over it.
  expect_energy("whole", sum_of(renderer->read("radiance").value()) / sum_of(truth("")), 0.985,
                1.01);
  expect_energy("direct", part_of({"sun", "local_lights"}, {"sun", "lamps"}), 0.99, 1.01);
  expect_energy("local lights", part_of({"local_lights"}, {"lamps"}), 0.975, 1.025);
  // The filter takes a little from one ray a pixel.
  expect_energy("indirect", part_of({"indirect"}, {"indirect"}), 0.96, 1.01);
  expect_energy("reflection", part_of({"reflection"}, {"reflection"}), 0.97, 1.03);

  EffectSettings many = renderer->context().settings.effects.at("reflections");
  many.samples = 64;
  ASSERT_TRUE(renderer->run("reflections", many).ok());
  FloatImage signal = renderer->read("reflection").value(), light = truth("reflection");
  divide_by_albedo(truth("specular_albedo"), signal, light);
  // Cells of 25 cm, which hits read where they are, are 3 % too bright at surfaces.
  expect_energy("reflections, 64 rays", sum_of(signal, &ids) / sum_of(light, &ids), 1.01, 1.055);
}

}  // namespace
}  // namespace kaamos::test
