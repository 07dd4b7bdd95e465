// SPDX-License-Identifier: MIT
// Tests what limits the filters of visibility, on signals whose penumbras are given. On both
// backends.
#include "effects/denoise/visibility_denoiser.h"

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "effects/denoise/denoise_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

constexpr float kHard = 1e6f;  // 1 / radius of the penumbra, 1/m

const DenoiseMethod kMethods[] = {DenoiseMethod::kTemporal, DenoiseMethod::kSvgf,
                                  DenoiseMethod::kControl};

class VisibilityDenoiserTest : public DenoiseFixture,
                               public testing::WithParamInterface<const char*> {
 protected:
  VisibilityDenoiserTest() : DenoiseFixture(64, 40, GetParam()) {
    sharpness_ = picture("sharpness");
    lights_ = frame_.create_picture(device_, "lights", rtapi::Format::kR32G32Uint).value();
    set_lights([](auto, auto) { return 0u; });
  }

  rtapi::Texture picture(const std::string& name) {
    return frame_.create_picture(device_, name, rtapi::Format::kR32G32B32A32Float).value();
  }
  void set_lights(const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& of) {
    std::vector<std::uint32_t> texels;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) texels.insert(texels.end(), 2, of(x, y));
    }
    rtapi::UploadTexture(device_, queue_, lights_, 0, std::as_bytes(std::span(texels))).value();
  }
  VisibilityDenoiser make(DenoiseMethod method, bool by_lights = false) {
    const VisibilityDenoiser::Signal signal = {"test", 1, signal_, sharpness_,
                                               by_lights ? lights_ : rtapi::Texture()};
    return VisibilityDenoiser::create(device_, frame_, denoise_libraries().value(), {signal},
                                      method)
        .value();
  }
  // Runs a frame in which all penumbras have the same width.
  FloatImage run(VisibilityDenoiser& denoiser, const Value& value, float sharpness,
                 bool moves = false) {
    FloatImage visible(kWidth, kHeight, 4), sharp(kWidth, kHeight, 4);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const float v = value(x, y);
        for (std::uint32_t c = 0; c < 3; ++c) visible.at(x, y, c) = v;
        sharp.at(x, y, 0) = (1 - v) * sharpness;
        sharp.at(x, y, 2) = moves ? 1 - v : 0;
      }
    }
    upload(signal_, visible);
    upload(sharpness_, sharp);
    rtapi::CommandList list = device_.CreateCommandList().value();
    denoiser.dispatch(list, frame_);
    queue_.ExecuteAndWait(list).value();
    return read_picture(device_, queue_, denoiser.result()).value();
  }

  rtapi::Texture sharpness_, lights_;
};

// A lattice and the leaves of a tree cast shadows as fine as this.
TEST_P(VisibilityDenoiserTest, ASharpShadowStaysAsItIs) {
  const auto lattice = [](auto x, auto y) { return x % 4 < 2 || y % 5 == 0 ? 1.0f : 0.0f; };
  for (const DenoiseMethod method : kMethods) {
    VisibilityDenoiser denoiser = make(method);
    for (int frame = 0; frame < 3; ++frame) {
      const FloatImage out = run(denoiser, lattice, kHard);
      for_surface([&](auto x, auto y) {
        ASSERT_NEAR(out.at(x, y), lattice(x, y), 1e-6) << static_cast<int>(method) << " " << frame;
      });
    }
  }
}

TEST_P(VisibilityDenoiserTest, AWidePenumbraLosesItsNoise) {
  for (const DenoiseMethod method : {DenoiseMethod::kSvgf, DenoiseMethod::kControl}) {
    VisibilityDenoiser denoiser = make(method);
    std::mt19937 random(3);
    std::bernoulli_distribution open(0.5);
    double left[2] = {0, 0};
    for (int frame = 0; frame < 8; ++frame) {
      const FloatImage out = run(
          denoiser, [&](auto, auto) { return open(random) ? 1.0f : 0.0f; }, 0.5f);
      double squares = 0, count = 0;
      for_surface([&](auto x, auto y) {
        squares += std::pow(out.at(x, y) - 0.5, 2);
        ++count;
      });
      if (frame == 0) left[0] = squares / count;
      if (frame == 7) left[1] = squares / count;
    }
    EXPECT_LT(left[0], 0.25 / 8) << static_cast<int>(method);
    EXPECT_LT(left[1], 0.25 / 24) << static_cast<int>(method);
  }
}

// Far from every shadow there is nothing to filter, however wide a filter could be.
TEST_P(VisibilityDenoiserTest, NoShadowIsFetchedFromAfar) {
  const auto edge = [this](auto x, auto) { return x < kWidth / 2 ? 0.0f : 1.0f; };
  for (const DenoiseMethod method : kMethods) {
    VisibilityDenoiser denoiser = make(method);
    const FloatImage out = run(denoiser, edge, 0.1f);
    for_surface([&](auto x, auto y) {
      if (x < kWidth / 2 + 9) return;
      ASSERT_EQ(out.at(x, y), 1.0f) << x << "," << y;
    });
  }
}

// A pixel and its neighbour may have chosen different lights.
TEST_P(VisibilityDenoiserTest, TwoLightsDoNotMix) {
  const auto light = [this](auto x, auto) { return x < kWidth / 2 ? 3u : 7u; };
  const auto value = [&](auto x, auto y) { return light(x, y) == 3u ? 0.0f : 1.0f; };
  for (const DenoiseMethod method : kMethods) {
    set_lights(light);
    VisibilityDenoiser denoiser = make(method, true);
    for (int frame = 0; frame < 4; ++frame) {
      const FloatImage out = run(denoiser, value, 0.1f);
      for_surface([&](auto x, auto y) { ASSERT_EQ(out.at(x, y), value(x, y)); });
    }
    // Now every pixel is lit by the other light.
    set_lights([&](auto x, auto y) { return 10u - light(x, y); });
    const FloatImage out = run(
        denoiser, [&](auto x, auto y) { return 1 - value(x, y); }, 0.1f);
    const FloatImage accumulated = read_picture(device_, queue_, denoiser.accumulated()).value();
    for_surface([&](auto x, auto y) {
      ASSERT_EQ(out.at(x, y), 1 - value(x, y));
      ASSERT_EQ(accumulated.at(x, y, 1), 1.0f) << "frames";
    });
  }
}

TEST_P(VisibilityDenoiserTest, ChannelsDoNotSeeEachOther) {
  const rtapi::Texture both = picture("both"), both_sharp = picture("both sharp");
  const rtapi::Texture one[2] = {picture("0"), picture("1")};
  const rtapi::Texture sharp[2] = {picture("sharp 0"), picture("sharp 1")};
  const DenoiseLibraries libraries = denoise_libraries().value();
  for (const DenoiseMethod method : kMethods) {
    VisibilityDenoiser together =
        VisibilityDenoiser::create(device_, frame_, libraries, {{"both", 2, both, both_sharp, {}}},
                                   method)
            .value();
    std::vector<VisibilityDenoiser> alone;
    for (int i = 0; i < 2; ++i) {
      alone.push_back(VisibilityDenoiser::create(device_, frame_, libraries,
                                                 {{"alone", 1, one[i], sharp[i], {}}}, method)
                          .value());
    }
    std::mt19937 random(8);
    std::uniform_real_distribution<float> uniform;
    for (int frame = 0; frame < 3; ++frame) {
      FloatImage pair(kWidth, kHeight, 4), pair_sharp(kWidth, kHeight, 4);
      for (float& v : pair.values) v = uniform(random);
      for (float& v : pair_sharp.values) v = 3 * uniform(random);
      upload(both, pair);
      upload(both_sharp, pair_sharp);
      for (std::uint32_t i = 0; i < 2; ++i) {
        FloatImage v(kWidth, kHeight, 4), s(kWidth, kHeight, 4);
        for (std::size_t p = 0; p < v.values.size(); p += 4) {
          v.values[p] = pair.values[p + i];
          s.values[p] = pair_sharp.values[p + i];
          s.values[p + 2] = pair_sharp.values[p + 2 + i];
        }
        upload(one[i], v);
        upload(sharp[i], s);
      }
      rtapi::CommandList list = device_.CreateCommandList().value();
      together.dispatch(list, frame_);
      for (VisibilityDenoiser& denoiser : alone) denoiser.dispatch(list, frame_);
      queue_.ExecuteAndWait(list).value();
      const FloatImage a = read_picture(device_, queue_, together.result()).value();
      for (std::uint32_t i = 0; i < 2; ++i) {
        const FloatImage b = read_picture(device_, queue_, alone[i].result()).value();
        for_surface([&](auto x, auto y) {
          ASSERT_EQ(a.at(x, y, i), b.at(x, y, 0)) << static_cast<int>(method) << " " << frame;
        });
      }
    }
  }
}

// A shadow leaves the right half of the picture. If its occluder moves, no pixel keeps any of it;
// if a light was switched on, at most single pixels do that share a surface with no other.
TEST_P(VisibilityDenoiserTest, AShadowThatMovesLeavesNoTrail) {
  const auto dark = [this](auto x, auto) { return x < kWidth / 2 ? 1.0f : 0.0f; };
  const auto open = [](auto, auto) { return 1.0f; };
  for (const bool moves : {true, false}) {
    for (const DenoiseMethod method : kMethods) {
      VisibilityDenoiser denoiser = make(method);
      for (int frame = 0; frame < 8; ++frame) run(denoiser, dark, kHard, moves);
      const FloatImage out = run(denoiser, open, kHard, moves);
      double worst = 0, sum = 0, count = 0;
      for_surface([&](auto x, auto y) {
        worst = std::max(worst, 1.0 - out.at(x, y));
        sum += 1.0 - out.at(x, y);
        ++count;
      });
      EXPECT_LT(moves ? worst : sum / count, moves ? 1e-6 : 0.01) << static_cast<int>(method);
    }
  }
}

// A shadow that passes by for one frame, half over each pixel. Nothing is in the way in the next
// frame, and its half light is no penumbra.
TEST_P(VisibilityDenoiserTest, AShadowThatPassesByIsGone) {
  const auto open = [](auto, auto) { return 1.0f; };
  const auto band = [](auto x, auto) { return x > 20 && x < 32 ? 0.5f : 1.0f; };
  for (const DenoiseMethod method : kMethods) {
    VisibilityDenoiser denoiser = make(method);
    for (int frame = 0; frame < 7; ++frame) run(denoiser, open, kHard, true);
    run(denoiser, band, kHard, true);
    const FloatImage out = run(denoiser, open, kHard, true);
    for_surface([&](auto x, auto y) {
      ASSERT_GT(out.at(x, y), 0.99f) << static_cast<int>(method) << " " << x << "," << y;
    });
  }
}

TEST_P(VisibilityDenoiserTest, WhatIsNotFiniteIsDarkInItsPixelOnly) {
  for (const DenoiseMethod method : kMethods) {
    VisibilityDenoiser denoiser = make(method);
    const auto broken = [](auto x, auto y) {
      if (x % 9 != 4 || y % 9 != 4) return 1.0f;
      return x % 2 == 0 ? std::nanf("") : INFINITY;
    };
    for (int frame = 0; frame < 2; ++frame) {
      const FloatImage out = run(denoiser, broken, kHard);
      for_surface([&](auto x, auto y) {
        ASSERT_EQ(out.at(x, y), x % 9 == 4 && y % 9 == 4 ? 0.0f : 1.0f) << x << "," << y;
      });
    }
  }
}

TEST_P(VisibilityDenoiserTest, RefusesWhatItCannotDo) {
  const DenoiseLibraries libraries = denoise_libraries().value();
  const VisibilityDenoiser::Signal signal = {"test", 2, signal_, sharpness_, {}};
  const auto message = [&](const std::vector<VisibilityDenoiser::Signal>& signals,
                           DenoiseMethod method) {
    const auto made = VisibilityDenoiser::create(device_, frame_, libraries, signals, method);
    return made ? std::string() : made.error().message;
  };
  EXPECT_NE(message({}, DenoiseMethod::kSvgf).find("of 0 channels: it takes 1 to 4"),
            std::string::npos);
  EXPECT_NE(message({signal, signal, signal}, DenoiseMethod::kSvgf).find("of 6 channels"),
            std::string::npos);
  EXPECT_NE(message({signal}, DenoiseMethod::kGaussian).find("Denoiser has the others"),
            std::string::npos);
}

std::vector<const char*> backends() {
  std::vector<const char*> out = {"embree"};
  if (test::why_no_vulkan().empty() || test::vulkan_is_required()) out.push_back("vulkan");
  return out;
}

INSTANTIATE_TEST_SUITE_P(Backends, VisibilityDenoiserTest, testing::ValuesIn(backends()),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace kaamos::effects
