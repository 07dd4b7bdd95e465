// SPDX-License-Identifier: MIT
// Enlarged pictures against what a picture of that size would show.
#include "effects/composition/enlarge/enlarge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "effects/assets/built_in/runner.h"
#include "effects/composition/taa/sequence_fixture.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 24;
constexpr float kFactor = 2;

using Pattern = std::function<double(double x, double y)>;  // of the picture's width and height

// Means over the points of each pixel.
FloatImage sampled(const Pattern& pattern, std::uint32_t width, std::uint32_t height) {
  constexpr int kPoints = 8;
  FloatImage image(width, height, 4);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      double sum = 0;
      for (int i = 0; i < kPoints * kPoints; ++i) {
        sum += pattern((x + (i % kPoints + 0.5) / kPoints) / width,
                       (y + (i / kPoints + 0.5) / kPoints) / height);
      }
      for (std::uint32_t c = 0; c < 3; ++c) {
        image.at(x, y, c) = static_cast<float>(sum / (kPoints * kPoints));
      }
    }
  }
  return image;
}

class Enlarge : public testing::Test {
 protected:
  Enlarge() : stage_(make_runner_scene({.crowd = 1}), kWidth, kHeight) { stage_.begin(0.0, {}); }

  FloatImage enlarge(const FloatImage& image, EnlargeMethod method, float factor = kFactor) {
    stage_.write(kRadiance, image);
    Enlarger pass = Enlarger::create(stage_.device, stage_.frame, enlarge_library().value(), factor,
                                     {.method = method})
                        .value();
    pass.bind(stage_.frame.texture(kRadiance)).value();
    stage_.run([&](rtapi::CommandList& list) { pass.dispatch(list, stage_.frame); });
    return stage_.read(pass.result());
  }
  // Root mean square off what the larger picture would show, without the border.
  double error(const Pattern& pattern, EnlargeMethod method) {
    const FloatImage found = enlarge(sampled(pattern, kWidth, kHeight), method);
    const FloatImage truth = sampled(pattern, found.width, found.height);
    double sum = 0;
    int count = 0;
    for (std::uint32_t y = 4; y < found.height - 4; ++y) {
      for (std::uint32_t x = 4; x < found.width - 4; ++x) {
        sum += std::pow(found.at(x, y, 0) - truth.at(x, y, 0), 2);
        ++count;
      }
    }
    return std::sqrt(sum / count);
  }

  SequenceStage stage_;
};

TEST_F(Enlarge, SizesAndFlatPicturesAreKept) {
  const FloatImage flat = sampled([](double, double) { return 0.4; }, kWidth, kHeight);
  for (const float factor : {1.0f, 1.5f, 4.0f}) {
    for (const auto method : {EnlargeMethod::kBilinear, EnlargeMethod::kAlongEdges}) {
      const FloatImage found = enlarge(flat, method, factor);
      EXPECT_EQ(found.width, static_cast<std::uint32_t>(std::lround(kWidth * factor)));
      EXPECT_EQ(found.height, static_cast<std::uint32_t>(std::lround(kHeight * factor)));
      for (std::uint32_t i = 0; i < found.width * found.height; ++i) {
        ASSERT_NEAR(found.values[found.channels * i], 0.4, 1e-5) << i;
      }
    }
  }
}

// Straight edges of many slopes, and a round one. Bilinear filters make stairs of them.
TEST_F(Enlarge, EdgesAreNearerToTheTruthThanBilinearOnes) {
  double bilinear = 0, own = 0;
  for (int i = 0; i < 16; ++i) {
    const double angle = 0.19635 * (i + 0.3);  // over half a turn
    const Pattern edge = [=](double x, double y) {
      return (x - 0.5) * std::cos(angle) * kWidth / kHeight + (y - 0.5) * std::sin(angle) > 0 ? 0.9
                                                                                              : 0.1;
    };
    bilinear += error(edge, EnlargeMethod::kBilinear);
    own += error(edge, EnlargeMethod::kAlongEdges);
  }
  EXPECT_LT(own, 0.87 * bilinear);
  const Pattern disk = [](double x, double y) {
    return std::hypot((x - 0.5) * kWidth / kHeight, y - 0.5) < 0.3 ? 0.9 : 0.1;
  };
  EXPECT_LT(error(disk, EnlargeMethod::kAlongEdges), 0.9 * error(disk, EnlargeMethod::kBilinear));
}

// A ramp is no edge, and stays a ramp.
TEST_F(Enlarge, RampsStayRamps) {
  const Pattern ramp = [](double x, double y) { return 0.2 + 0.3 * x + 0.2 * y; };
  EXPECT_LT(error(ramp, EnlargeMethod::kAlongEdges), 0.004);
}

// Negative lobes make no halos, not beside a lamp either.
TEST_F(Enlarge, NothingIsBrighterOrDarkerThanItsSurroundings) {
  const Pattern lamp = [](double x, double y) {
    return std::hypot((x - 0.5) * kWidth / kHeight, y - 0.5) < 0.2 ? 1e4 : 0.01;
  };
  const FloatImage small = sampled(lamp, kWidth, kHeight);
  const FloatImage found = enlarge(small, EnlargeMethod::kAlongEdges);
  for (std::uint32_t y = 0; y < found.height; ++y) {
    for (std::uint32_t x = 0; x < found.width; ++x) {
      float least = 1e30f, most = 0;
      for (int i = 0; i < 4; ++i) {
        const int u = static_cast<int>(std::floor((x + 0.5) / kFactor - 0.5)) + i % 2;
        const int v = static_cast<int>(std::floor((y + 0.5) / kFactor - 0.5)) + i / 2;
        const float value =
            small.at(static_cast<std::uint32_t>(std::clamp(u, 0, int{kWidth} - 1)),
                     static_cast<std::uint32_t>(std::clamp(v, 0, int{kHeight} - 1)), 0);
        least = std::min(least, value);
        most = std::max(most, value);
      }
      ASSERT_GE(found.at(x, y, 0), least * 0.999f) << x << ", " << y;
      ASSERT_LE(found.at(x, y, 0), most * 1.01f) << x << ", " << y;
    }
  }
}

TEST_F(Enlarge, BrokenLightStaysFinite) {
  FloatImage image = sampled([](double, double) { return 0.5; }, kWidth, kHeight);
  image.at(5, 5, 0) = std::numeric_limits<float>::quiet_NaN();
  image.at(15, 5, 1) = std::numeric_limits<float>::infinity();
  image.at(25, 5, 2) = -1;
  for (const float value : enlarge(image, EnlargeMethod::kAlongEdges).values) {
    ASSERT_TRUE(std::isfinite(value));
    ASSERT_GE(value, 0.0f);
  }
}

}  // namespace
}  // namespace kaamos::effects
