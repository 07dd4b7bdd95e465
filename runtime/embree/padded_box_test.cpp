// SPDX-License-Identifier: MIT
#include "runtime/embree/padded_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kaamos::embree {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

RTCRay ray_of(const float (&origin)[3], const float (&direction)[3], float t_near = 0,
              float t_far = kInfinity) {
  RTCRay ray = {};
  ray.org_x = origin[0];
  ray.org_y = origin[1];
  ray.org_z = origin[2];
  ray.dir_x = direction[0];
  ray.dir_y = direction[1];
  ray.dir_z = direction[2];
  ray.tnear = t_near;
  ray.tfar = t_far;
  return ray;
}

bool meets(const rtapi::RaytracingAabb& box, const RTCRay& ray) {
  return PaddedBox::of(box).meets(ray);
}

TEST(PaddedBox, TheIntervalIsClosed) {
  const rtapi::RaytracingAabb box = {-1, -1, 4, 1, 1, 8};
  EXPECT_TRUE(meets(box, ray_of({0, 0, 0}, {0, 0, 1})));
  EXPECT_TRUE(meets(box, ray_of({0, 0, 0}, {0, 0, 2}, 0, 2)));
  EXPECT_TRUE(meets(box, ray_of({0, 0, 0}, {0, 0, 2}, 4, 9)));
  EXPECT_TRUE(meets(box, ray_of({0, 0, 6}, {0, 0, -1}, 0, 0)));
  EXPECT_FALSE(meets(box, ray_of({0, 0, 0}, {0, 0, 2}, 0, 1.99f)));
  EXPECT_FALSE(meets(box, ray_of({0, 0, 0}, {0, 0, 2}, 4.01f, 9)));
  EXPECT_FALSE(meets(box, ray_of({0, 0, 0}, {0, 0, -1})));
  EXPECT_FALSE(meets(box, ray_of({0, 0, 9}, {0, 0, 1})));
  EXPECT_FALSE(meets(box, ray_of({1.01f, 0, 0}, {0, 0, 1})));
}

TEST(PaddedBox, FacesEdgesAndCornersBelongToIt) {
  const rtapi::RaytracingAabb box = {1, 2, 3, 2, 4, 3};  // a plate
  EXPECT_TRUE(meets(box, ray_of({1, 2, 0}, {0, 0, 1})));
  EXPECT_TRUE(meets(box, ray_of({2, 4, 0}, {-0.0f, 0, 1})));
  EXPECT_TRUE(meets(box, ray_of({0, 2, 3}, {1, 0, -0.0f})));
  EXPECT_TRUE(meets(box, ray_of({0, 1, 3}, {1, 1, 0})));
  // In a face of the box as it is padded, where differences are 0 and reciprocals infinite.
  const runtime::PaddedBounds padded = runtime::padded_bounds(box);
  for (const float zero : {0.0f, -0.0f}) {
    EXPECT_TRUE(meets(box, ray_of({padded.lower[0], 3, 0}, {zero, 0, 1})));
    EXPECT_TRUE(meets(box, ray_of({padded.upper[0], 3, 0}, {zero, 0, 1})));
    EXPECT_TRUE(meets(box, ray_of({padded.lower[0], padded.upper[1], 0}, {zero, zero, 1})));
  }
}

TEST(PaddedBox, InactiveBoxesMeetNothing) {
  for (const rtapi::RaytracingAabb& box :
       {rtapi::RaytracingAabb{kNan, 0, 0, 1, 1, 1}, rtapi::RaytracingAabb{0, 0, 0, 1, 1, kNan}}) {
    EXPECT_FALSE(meets(box, ray_of({0.5f, 0.5f, -1}, {0, 0, 1})));
    EXPECT_FALSE(meets(box, ray_of({0.5f, 0.5f, 0.5f}, {0, 0, 0})));
  }
}

// Against the slabs in long double: no ray that meets the box is refused, and none that passes it
// at a thousandth of its distance is accepted.
TEST(PaddedBox, RoundingLosesNoRay) {
  std::mt19937 random(7);
  const auto between = [&random](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24f;
  };
  uint32_t met = 0;
  uint32_t passed = 0;
  for (int round = 0; round < 200000; ++round) {
    const float scale = std::ldexp(1.0f, static_cast<int>(random() % 40) - 20);
    float origin[3], low[3], high[3], direction[3];
    for (int i = 0; i < 3; ++i) {
      low[i] = between(-8, 8) * scale;
      high[i] = low[i] + (random() % 8 == 0 ? 0 : between(0, 2) * scale);
      origin[i] = between(-20, 20) * scale;
      // Through a point of the box, or of one of its faces, or near it.
      const float target = low[i] + (high[i] - low[i]) * static_cast<float>(random() % 5) * 0.25f;
      direction[i] = target + (random() % 4 == 0 ? between(-1, 1) * scale : 0) - origin[i];
    }
    const RTCRay ray = ray_of(origin, direction, 0, 2);
    const auto interval = [&](long double room) {
      long double enter = ray.tnear, leave = ray.tfar;
      for (int i = 0; i < 3; ++i) {
        const long double to_low = (long double){low[i]} - room - origin[i];
        const long double to_high = (long double){high[i]} + room - origin[i];
        if (direction[i] == 0) {
          if (to_low > 0 || to_high < 0) leave = -1;
          continue;
        }
        const long double a = to_low / direction[i], b = to_high / direction[i];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      return leave - enter;
    };
    const bool found = meets({low[0], low[1], low[2], high[0], high[1], high[2]}, ray);
    if (interval(0) >= 0) {
      ++met;
      ASSERT_TRUE(found) << round;
    } else if (interval(0.02L * scale) < 0) {
      ++passed;
      ASSERT_FALSE(found) << round;
    }
  }
  EXPECT_GT(met, 60000u);
  EXPECT_GT(passed, 20000u);
}

}  // namespace
}  // namespace kaamos::embree
