// SPDX-License-Identifier: MIT
// Half resolution whose traced pixel of each 2 x 2 takes turns.
#include <rtapi/upload.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>

#include "effects/assets/image/edge_band.h"
#include "effects/denoise/stage_fixture.h"

namespace kaamos::effects {
namespace {

// Four frames trace every pixel once, and only those of their turn. The picture ends in the middle
// of a block.
TEST(RotatingPixels, FourFramesTraceEveryPixelOnce) {
  Scene scene = make_stage();
  const std::uint32_t width = 33, height = 19;
  Show show(scene, {.effects = {"ao", "gi"},
                    .width = width,
                    .height = height,
                    .pixel_step = 2,
                    .rotates = true});
  show.render();
  FrameRenderer& renderer = show.renderer();
  for (const char* signal : {"ao", "indirect"}) {
    const rtapi::Texture sum = renderer.effects().sum(signal);
    const std::uint32_t channels = signal[0] == 'a' ? 1 : 4;
    const FloatImage none(width, height, channels, -1000.0f);
    std::vector<std::uint32_t> times(width * height);
    for (int frame = 0; frame < 4; ++frame) {
      rtapi::UploadTexture(renderer.device(), renderer.queue(), sum, 0,
                           std::as_bytes(std::span(none.values)))
          .value();
      show.render();
      const FloatImage picture = renderer.read(sum).value();
      std::uint32_t traced = 0;
      for (std::size_t i = 0; i < times.size(); ++i) {
        if (picture.values[i * channels] == -1000.0f) continue;
        ++times[i];
        ++traced;
      }
      EXPECT_GE(traced, (width / 2) * (height / 2)) << signal;
      EXPECT_LE(traced, (width / 2 + 1) * (height / 2 + 1)) << signal;
    }
    EXPECT_EQ(std::count(times.begin(), times.end(), 1u), width * height) << signal;
  }
}

struct Error {
  double edges = 0, elsewhere = 0;
};

// RMSE within three pixels of depth edges, and of all other surfaces.
Error error_of(const FloatImage& image, const FloatImage& truth, const FloatImage& view_z) {
  const std::vector<bool> band = edge_band(view_z, 3);
  double sums[2] = {}, counts[2] = {};
  for (std::size_t i = 0; i < band.size(); ++i) {
    if (!(view_z.values[i] > 0)) continue;
    const double off = double{image.values[i * image.channels]} - truth.values[i * truth.channels];
    sums[band[i]] += off * off;
    counts[band[i]] += 1;
  }
  EXPECT_GT(counts[1], 100);
  EXPECT_GT(counts[0], 100);
  return {std::sqrt(sums[1] / counts[1]), std::sqrt(sums[0] / counts[0])};
}

// The error of an effect's signal after twelve frames, with the camera at rest or moving.
Error error_of_frames(const std::string& effect, std::uint32_t pixel_step, bool rotates,
                      bool moves) {
  constexpr std::uint32_t kWidth = 64, kHeight = 48;
  Scene scene = make_stage();
  Show show(scene, {.effects = {effect},
                    .width = kWidth,
                    .height = kHeight,
                    .pixel_step = pixel_step,
                    .rotates = rotates,
                    .samples = 4});
  const auto at = [&](int frame) { return glm::dvec3(moves ? 0.02 * frame : 0, 0, 0); };
  constexpr int kLast = 11;
  for (int frame = 0; frame <= kLast; ++frame) show.render(0, at(frame));
  Show truth(scene, {.effects = {effect}, .width = kWidth, .height = kHeight, .samples = 256});
  truth.render(0, at(kLast));
  return error_of(show.read(effect + "_denoised"), truth.read(effect), truth.read("view_z"));
}

// A sharp shadow gains most: its edge lies between pixels of which a quarter have rays at once. The
// same holds for a moving camera: nothing trails.
TEST(RotatingPixels, FramesFillInEachOthersPixels) {
  for (const std::string effect : {"ao", "sun"}) {
    for (const bool moves : {false, true}) {
      const Error full = error_of_frames(effect, 1, false, moves);
      const Error half = error_of_frames(effect, 2, false, moves);
      const Error rotating = error_of_frames(effect, 2, true, moves);
      std::printf(
          "%s, %s, RMSE at edges and elsewhere: full %.4f %.4f, half %.4f %.4f, rotating %.4f "
          "%.4f\n",
          effect.c_str(), moves ? "moving" : "still", full.edges, full.elsewhere, half.edges,
          half.elsewhere, rotating.edges, rotating.elsewhere);
      const double share = effect == "sun" ? 0.7 : moves ? 1.1 : 1.0;
      EXPECT_LT(rotating.edges, share * half.edges) << effect << moves;
      EXPECT_LT(rotating.elsewhere, half.elsewhere) << effect << moves;
    }
  }
}

}  // namespace
}  // namespace kaamos::effects
