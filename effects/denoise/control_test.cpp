// SPDX-License-Identifier: MIT
// Tests what each stage of Control's denoiser is for. [Control]
#include <random>

#include "effects/denoise/denoise_fixture.h"

namespace kaamos::effects {
namespace {

class ControlDenoiseTest : public DenoiseFixture {
 protected:
  // Roughness is stored in 8 bits per channel.
  void set_roughness(const std::function<float(std::uint32_t)>& of_column) {
    std::vector<std::uint8_t> texels(std::size_t{4} * kWidth * kHeight, 0);
    for (std::size_t i = 0; i < texels.size(); i += 4) {
      texels[i] = static_cast<std::uint8_t>(255 * of_column(i / 4 % kWidth));
    }
    rtapi::UploadTexture(device_, queue_, frame_.texture(kMaterial), 0,
                         std::as_bytes(std::span(texels)))
        .value();
  }
  static DenoiseDesc of_reflections() {
    DenoiseDesc desc = default_denoise(DenoiseMethod::kControl);
    desc.constants.lobe_scale = 1;
    return desc;
  }
  // Mean square of the noise about 1 that is left after some frames.
  double noise_after(const DenoiseDesc& desc, float hit, int frames = 1) {
    Denoiser denoiser = make(desc);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0f, 2.0f);
    FloatImage out;
    for (int i = 0; i < frames; ++i) {
      out = run(
          denoiser, [&](auto, auto) { return uniform(random); }, hit);
    }
    double squares = 0, count = 0;
    for_surface([&](auto x, auto y) {
      squares += std::pow(out.at(x, y) - 1, 2);
      ++count;
    });
    return squares / count;
  }
};

// The sources' own clamp: what is bright and alone is gone, with its light.
TEST_F(ControlDenoiseTest, FirefliesGo) {
  set_roughness([](auto) { return 0.5f; });
  const auto value = [](auto x, auto y) { return x % 16 == 8 && y % 16 == 8 ? 1000.0f : 0.5f; };
  for (const bool reflections : {true, false}) {
    DenoiseDesc desc = reflections ? of_reflections() : default_denoise(DenoiseMethod::kControl);
    desc.constants.keep_energy = 0;
    Denoiser denoiser = make(desc);
    const FloatImage out = run(denoiser, value, 10);
    double brightest = 0;
    for_surface([&](auto x, auto y) { brightest = std::max<double>(brightest, out.at(x, y)); });
    EXPECT_LT(brightest, 0.51);
  }
}

// One ray a pixel finds light only now and then. What filters make of it is as bright, and the
// sources' clamps of fireflies and history lose a good part of it.
TEST_F(ControlDenoiseTest, SparseLightKeepsItsEnergy) {
  set_roughness([](auto) { return 0.5f; });
  for (const DenoiseMethod method : {DenoiseMethod::kTemporal, DenoiseMethod::kControl}) {
    for (const bool keeps : {true, false}) {
      DenoiseDesc desc = default_denoise(method);
      desc.constants.keep_energy = keeps ? 1 : 0;
      Denoiser denoiser = make(desc);
      std::mt19937 random(11);
      std::uniform_real_distribution<float> uniform;
      double sum = 0, count = 0;
      for (int frame = 0; frame < 120; ++frame) {
        const FloatImage out = run(
            denoiser, [&](auto, auto) { return uniform(random) < 0.0625f ? 16.0f : 0.0f; }, 10);
        if (frame < 20) continue;
        for_surface([&](auto x, auto y) {
          sum += out.at(x, y);
          ++count;
        });
      }
      if (keeps) {
        EXPECT_NEAR(sum / count, 1, 0.03) << static_cast<int>(method);
      } else {
        EXPECT_LT(sum / count, 0.8) << static_cast<int>(method);
      }
    }
  }
}

TEST_F(ControlDenoiseTest, AMirrorStaysAsItIs) {
  set_roughness([](auto) { return 0.0f; });
  Denoiser denoiser = make(of_reflections());
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform;
  FloatImage shown(kWidth, kHeight, 1);
  for (float& v : shown.values) v = uniform(random) < 0.02f ? 50.0f : uniform(random);
  const FloatImage out = run(
      denoiser, [&](auto x, auto y) { return shown.at(x, y); }, 10);
  for_surface([&](auto x, auto y) { ASSERT_EQ(out.at(x, y), shown.at(x, y)); });
}

// Holds for SVGF too. The left half of the picture is a mirror, the right half is rough. A signal
// that does not come from reflections is filtered in both halves.
TEST_F(ControlDenoiseTest, SvgfLeavesMirrorsAsTheyAre) {
  set_roughness([this](auto x) { return x < kWidth / 2 ? 0.02f : 0.5f; });
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform;
  for (const bool of_lobe : {true, false}) {
    Denoiser denoiser =
        Denoiser::create(device_, frame_, denoise_libraries().value(), {{"test", signal_, of_lobe}},
                         default_denoise(DenoiseMethod::kSvgf))
            .value();
    for (int frame = 0; frame < 6; ++frame) {
      FloatImage shown(kWidth, kHeight, 1);
      for (float& v : shown.values) v = uniform(random) < 0.02f ? 50.0f : uniform(random);
      const FloatImage out = run(denoiser, [&](auto x, auto y) { return shown.at(x, y); });
      int kept[2] = {0, 0};
      int all[2] = {0, 0};
      for_surface([&](auto x, auto y) {
        const int half = x < kWidth / 2 ? 0 : 1;
        ++all[half];
        kept[half] += out.at(x, y) == shown.at(x, y) ? 1 : 0;
      });
      ASSERT_GT(all[0], 200);
      ASSERT_GT(all[1], 200);
      EXPECT_EQ(kept[0] == all[0], of_lobe) << frame;
      EXPECT_LT(kept[1], all[1] / 100) << frame;
    }
  }
}

TEST_F(ControlDenoiseTest, TheFilterIsAsWideAsTheLobe) {
  set_roughness([](auto) { return 1.0f; });
  const double far = noise_after(of_reflections(), 50);
  const double near = noise_after(of_reflections(), 0.001f);
  EXPECT_LT(far, 0.33 / 20);  // a twentieth of the variance of a uniform distribution
  EXPECT_GT(near, 2 * far);   // reflections of things that touch the surface are sharp
  set_roughness([](auto) { return 0.1f; });
  EXPECT_GT(noise_after(of_reflections(), 50), 2 * far);
}

TEST_F(ControlDenoiseTest, FramesAddUp) {
  set_roughness([](auto) { return 0.5f; });
  const DenoiseDesc fixed = default_denoise(DenoiseMethod::kControl);
  EXPECT_LT(noise_after(fixed, 0, 8), 0.5 * noise_after(fixed, 0, 1));
}

// Two materials side by side: neither receives the other's light.
TEST_F(ControlDenoiseTest, SmoothnessStopsTheLight) {
  set_roughness([&](auto x) { return x < kWidth / 2 ? 0.6f : 1.0f; });
  Denoiser denoiser = make(of_reflections());
  const auto value = [&](auto x, auto) { return x < kWidth / 2 ? 0.0f : 1.0f; };
  const FloatImage out = run(denoiser, value, 10);
  for_surface(
      [&](auto x, auto y) { ASSERT_NEAR(out.at(x, y), value(x, y), 0.02) << x << "," << y; });
}

}  // namespace
}  // namespace kaamos::effects
