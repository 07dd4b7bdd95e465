// SPDX-License-Identifier: MIT
#include "runtime/embree/lane_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "runtime/embree/ray_setup.h"

namespace kaamos::embree {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  float symmetric() { return static_cast<float>(engine_()) * 0x1p-31f - 1.0f; }
  uint32_t below(uint32_t end) { return engine_() % end; }
  float one_of(std::initializer_list<float> values) {
    return values.begin()[below(static_cast<uint32_t>(values.size()))];
  }

 private:
  std::mt19937 engine_;
};

RTCBounds random_box(Random& random, float scale) {
  if (random.below(9) == 0) {
    return {kInfinity, kInfinity, kInfinity, 0, -kInfinity, -kInfinity, -kInfinity, 0};
  }
  float sides[2][3];
  for (int axis = 0; axis < 3; ++axis) {
    const float a = scale * random.symmetric();
    const float b = random.below(4) == 0 ? a : scale * random.symmetric();
    sides[0][axis] = std::min(a, b);
    sides[1][axis] = std::max(a, b);
  }
  return {sides[0][0], sides[0][1], sides[0][2], 0, sides[1][0], sides[1][1], sides[1][2], 0};
}

// Some are not valid rays, or have numbers at the limits of float.
shader::LaneRays random_rays(Random& random, float scale) {
  shader::LaneRays rays;
  for (int lane = 0; lane < shader::kLanes; ++lane) {
    for (int axis = 0; axis < 3; ++axis) {
      rays.origin[axis][lane] = 2 * scale * random.symmetric();
      rays.direction[axis][lane] = random.below(4) == 0
                                       ? random.one_of({0.0f, -0.0f, 1e-38f, -1e-42f, 1e18f})
                                       : random.symmetric();
    }
    rays.t_min[lane] = 0;
    rays.t_max[lane] = kInfinity;
    if (random.below(2) == 0) {
      rays.t_min[lane] = random.one_of({-0.0f, -3.0f, 1e-42f, FLT_MIN, 0.5f * scale, 1e30f});
    }
    if (random.below(2) == 0) {
      rays.t_max[lane] = random.one_of({FLT_MAX, 3 * scale, FLT_MIN, 0.0f, -1.0f, 1e-42f});
    }
    if (random.below(4) != 0) continue;
    const float wrong = random.one_of({kNaN, kInfinity, -kInfinity, 2e18f, -2e18f, FLT_MAX});
    switch (random.below(4)) {
      case 0:
        rays.origin[random.below(3)][lane] = wrong;
        break;
      case 1:
        rays.direction[random.below(3)][lane] = wrong;
        break;
      case 2:
        rays.t_min[lane] = wrong;
        break;
      default:
        rays.t_max[lane] = wrong;
        break;
    }
  }
  return rays;
}

// Bit for bit what each ray gives by itself.
void expect_as_one_by_one(const shader::LaneRays& rays, const InstanceBoxes& boxes,
                          shader::CpuLevel level, uint32_t& valid_rays, uint32_t& entered_boxes) {
  LaneSearches searches;
  search_lanes(rays, boxes, searches, level);
  EXPECT_EQ(searches.valid >> shader::kLanes, 0u);
  for (int lane = 0; lane < shader::kLanes; ++lane) {
    const ObjectRay world = {without_fourth_lane(origin_t_min(rays, lane)),
                             without_fourth_lane(direction_t_max(rays, lane))};
    const bool valid = is_valid(world, rays.t_min[lane], rays.t_max[lane]);
    ASSERT_EQ((searches.valid >> lane & 1) != 0, valid) << lane;
    if (!valid) continue;
    ++valid_rays;
    const float t_min = rays.t_min[lane] > 0 ? rays.t_min[lane] : 0.0f;
    EXPECT_EQ(searches.t_near[lane], next_above(t_min)) << t_min;
    EXPECT_EQ(searches.t_far[lane], next_below(rays.t_max[lane])) << rays.t_max[lane];
    RTCRay ray = {};
    _mm_store_ps(&ray.org_x, with_fourth_lane(world.origin, t_min));
    _mm_store_ps(&ray.dir_x, world.direction);
    ray.tfar = rays.t_max[lane];
    alignas(16) float entry[kMostInstanceBoxes];
    const EnteredBoxes entered = boxes.enter(ray, entry);
    ASSERT_EQ(searches.entered[lane], entered) << lane;
    for (EnteredBoxes left = entered; left != 0; left &= left - 1) {
      const auto box = static_cast<uint32_t>(std::countr_zero(left));
      EXPECT_EQ(searches.entries_of(lane)[box], entry[box]) << lane << ", " << box;
      ++entered_boxes;
    }
  }
}

TEST(LaneRays, AreSearchedAsOneByOne) {
  std::vector<shader::CpuLevel> levels = {shader::CpuLevel::kBaseline};
  if (shader::cpu_level() == shader::CpuLevel::kAvx2) levels.push_back(shader::CpuLevel::kAvx2);
  for (const shader::CpuLevel level : levels) {
    Random random(1);
    uint32_t valid_rays = 0;
    uint32_t entered_boxes = 0;
    for (const float scale : {1e-9f, 1e-3f, 1.0f, 1e6f, 5e17f}) {
      for (uint32_t count = 1; count <= kMostInstanceBoxes; ++count) {
        std::vector<RTCBounds> bounds;
        for (uint32_t i = 0; i < count; ++i) bounds.push_back(random_box(random, scale));
        InstanceBoxes boxes;
        boxes.set(bounds);
        for (int i = 0; i < 40; ++i) {
          expect_as_one_by_one(random_rays(random, scale), boxes, level, valid_rays, entered_boxes);
        }
      }
    }
    EXPECT_GT(valid_rays, 10000u);
    EXPECT_GT(entered_boxes, 3000u);
  }
}

}  // namespace
}  // namespace kaamos::embree
