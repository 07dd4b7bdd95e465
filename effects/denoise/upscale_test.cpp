// SPDX-License-Identifier: MIT
// Upscaling from a quarter of the pixels.
#include <limits>

#include "effects/denoise/denoise_fixture.h"

namespace kaamos::effects {
namespace {

class UpscaleTest : public DenoiseFixture {
 protected:
  explicit UpscaleTest(std::uint32_t width = 64, std::uint32_t height = 40)
      : DenoiseFixture(width, height) {}

  // Upscales a sum of one or four channels in which only even pixels are valid.
  FloatImage upscale(bool scalar, const Value& value) {
    const std::uint32_t channels = scalar ? 1 : 4;
    const rtapi::Texture sum =
        frame_
            .create_picture(device_, "sum",
                            scalar ? rtapi::Format::kR32Float : rtapi::Format::kR32G32B32A32Float)
            .value();
    FloatImage image(kWidth, kHeight, channels, -1000.0f);
    for (std::uint32_t y = 0; y < kHeight; y += 2) {
      for (std::uint32_t x = 0; x < kWidth; x += 2) {
        for (std::uint32_t c = 0; c < channels; ++c) image.at(x, y, c) = 2 * value(x, y);
      }
    }
    upload(sum, image);
    Denoiser denoiser = make(default_denoise(DenoiseMethod::kNone));
    denoiser.create_load(device_, frame_, denoise_libraries().value(), sum, 2).value();
    rtapi::CommandList list = device_.CreateCommandList().value();
    denoiser.load(list, frame_, 0.5f);
    queue_.ExecuteAndWait(list).value();
    return read_picture(device_, queue_, signal_).value();
  }

  void expect_constants_stay() {
    for (const bool scalar : {false, true}) {
      const FloatImage out = upscale(scalar, [](auto, auto) { return 0.7f; });
      for_surface([&](auto x, auto y) {
        for (std::uint32_t c = 0; c < 3; ++c) ASSERT_NEAR(out.at(x, y, c), 0.7f, 2e-7f);
      });
    }
  }

  // Bilinear interpolation between traced pixels, without guides.
  double bilinear(const Value& value, std::uint32_t x, std::uint32_t y) const {
    double sum = 0, weights = 0;
    for (const std::uint32_t dy : {0u, 1u}) {
      for (const std::uint32_t dx : {0u, 1u}) {
        const std::uint32_t tx = (x / 2 + dx) * 2, ty = (y / 2 + dy) * 2;
        const double weight =
            (1 - std::abs(int(tx) - int(x)) / 2.0) * (1 - std::abs(int(ty) - int(y)) / 2.0);
        if (tx >= kWidth || ty >= kHeight || weight <= 0) continue;
        sum += weight * value(tx, ty);
        weights += weight;
      }
    }
    return sum / weights;
  }
};

class OddUpscaleTest : public UpscaleTest {
 protected:
  OddUpscaleTest() : UpscaleTest(63, 37) {}
};

TEST_F(UpscaleTest, ConstantsStay) {
  expect_constants_stay();
}
TEST_F(OddUpscaleTest, ConstantsStay) {
  expect_constants_stay();
}

TEST_F(UpscaleTest, TracedPixelsStay) {
  const auto value = [](auto x, auto y) { return 0.1f + 0.01f * static_cast<float>(x * y % 17); };
  const FloatImage out = upscale(false, value);
  for_surface([&](auto x, auto y) {
    if (x % 2 == 0 && y % 2 == 0) {
      ASSERT_NEAR(out.at(x, y), value(x, y), 1e-6f);
    }
  });
}

TEST_F(UpscaleTest, EdgesAreKept) {
  const auto value = [&](auto x, auto y) { return is_sphere(x, y) ? 1.0f : 0.0f; };
  const FloatImage out = upscale(true, value);
  double ours = 0, plain = 0;
  for_surface([&](auto x, auto y) {
    ours += std::pow(out.at(x, y) - value(x, y), 2);
    plain += std::pow(bilinear(value, x, y) - value(x, y), 2);
  });
  EXPECT_GT(plain, 4);
  EXPECT_LT(ours, 0.02 * plain);
}

// A smooth signal on one surface stays smooth.
TEST_F(UpscaleTest, RampsAreKept) {
  const auto value = [&](auto x, auto) { return static_cast<float>(x); };
  const FloatImage out = upscale(false, value);
  double worst = 0;
  for_surface([&](auto x, auto y) {
    if (is_sphere(x, y) || x < 3 || x + 3 >= kWidth || y < 3 || y + 3 >= kHeight) return;
    // Skip pixels near the silhouette, which have neighbours on one side only.
    for (int d = -2; d <= 2; ++d) {
      if (is_sphere(x + d, y) || !is_surface(x + d, y) || is_sphere(x, y + d) ||
          !is_surface(x, y + d) || is_sphere(x + d, y + 1) || is_sphere(x + d, y - 1)) {
        return;
      }
    }
    worst = std::max(worst, std::abs(double{out.at(x, y)} - x));
  });
  EXPECT_LT(worst, 0.05);
}

TEST_F(UpscaleTest, WhatIsNotFiniteIsLeftOut) {
  const FloatImage out = upscale(false, [](auto x, auto y) {
    if (x % 6 != 0 || y % 6 != 0) return 0.5f;
    return x % 4 == 0 ? std::numeric_limits<float>::quiet_NaN()
                      : -std::numeric_limits<float>::infinity();
  });
  for_surface([&](auto x, auto y) { ASSERT_NEAR(out.at(x, y), 0.5f, 1e-6f) << x << "," << y; });
}

}  // namespace
}  // namespace kaamos::effects
