// SPDX-License-Identifier: MIT
#include "runtime/embree/instance_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <random>

#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

RTCRay ray_of(const float (&origin)[3], const float (&direction)[3], float t_near, float t_far) {
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

// The part of a ray inside a box, in double; if entry is above exit, the ray misses the box.
struct Interval {
  double entry;
  double exit;
};
Interval interval_of(const RTCRay& ray, const RTCBounds& box) {
  Interval interval = {ray.tnear, ray.tfar};
  const float origin[3] = {ray.org_x, ray.org_y, ray.org_z};
  const float direction[3] = {ray.dir_x, ray.dir_y, ray.dir_z};
  const float lower[3] = {box.lower_x, box.lower_y, box.lower_z};
  const float upper[3] = {box.upper_x, box.upper_y, box.upper_z};
  for (int axis = 0; axis < 3; ++axis) {
    const double to_lower = double{lower[axis]} - origin[axis];
    const double to_upper = double{upper[axis]} - origin[axis];
    if (direction[axis] == 0) {
      if (to_lower > 0 || to_upper < 0) interval.exit = -1;
      continue;
    }
    const double a = to_lower / direction[axis];
    const double b = to_upper / direction[axis];
    interval.entry = std::max(interval.entry, std::min(a, b));
    interval.exit = std::min(interval.exit, std::max(a, b));
  }
  return interval;
}

RTCBounds widened(const RTCBounds& box) {
  const auto room = [](float side) { return 4 * FLT_EPSILON * std::fabs(side) + 1e-24f; };
  return {box.lower_x - room(box.lower_x), box.lower_y - room(box.lower_y),
          box.lower_z - room(box.lower_z), 0,
          box.upper_x + room(box.upper_x), box.upper_y + room(box.upper_y),
          box.upper_z + room(box.upper_z), 0};
}

// No box that is entered may be missing, no box that the ray passes at a distance may be reported,
// and no entry may be later than it really is, because it decides what a hit hides.
void expect_like_reference(const std::vector<RTCBounds>& bounds, const RTCRay& ray) {
  InstanceBoxes boxes;
  boxes.set(bounds);
  alignas(16) float entry[kMostInstanceBoxes];
  const EnteredBoxes entered = boxes.enter(ray, entry);
  for (size_t i = 0; i < bounds.size(); ++i) {
    const Interval expected = interval_of(ray, bounds[i]);
    const Interval earliest = interval_of(ray, widened(bounds[i]));
    const bool found = (entered >> i & 1) != 0;
    if (expected.entry <= expected.exit) {
      EXPECT_TRUE(found) << i << ": " << expected.entry << " to " << expected.exit;
    } else if (earliest.entry > (1 + 1e-6) * earliest.exit) {
      EXPECT_FALSE(found) << i << ": " << expected.entry << " to " << expected.exit;
    }
    if (!found) continue;
    EXPECT_LE(entry[i], expected.entry) << i;
    EXPECT_GE(entry[i], (1 - 1e-6) * earliest.entry) << i;
  }
  EXPECT_EQ(uint64_t{entered} >> bounds.size(), 0u);
}

class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  float symmetric() { return static_cast<float>(engine_()) * 0x1p-31f - 1.0f; }
  uint32_t below(uint32_t end) { return engine_() % end; }

 private:
  std::mt19937 engine_;
};

RTCBounds random_box(Random& random, float scale) {
  float sides[2][3];
  for (int axis = 0; axis < 3; ++axis) {
    const float a = scale * random.symmetric();
    const float b = random.below(4) == 0 ? a : scale * random.symmetric();  // sometimes flat
    sides[0][axis] = std::min(a, b);
    sides[1][axis] = std::max(a, b);
  }
  return {sides[0][0], sides[0][1], sides[0][2], 0, sides[1][0], sides[1][1], sides[1][2], 0};
}

// Rays that start anywhere, or on a side of a box, and go in any direction, or along an axis.
RTCRay random_ray(Random& random, float scale, const std::vector<RTCBounds>& bounds) {
  float origin[3];
  float direction[3];
  const RTCBounds& box = bounds[random.below(static_cast<uint32_t>(bounds.size()))];
  const float lower[3] = {box.lower_x, box.lower_y, box.lower_z};
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis] = random.below(4) == 0 ? lower[axis] : 2 * scale * random.symmetric();
    direction[axis] = random.symmetric();
    if (random.below(4) == 0) direction[axis] = random.below(2) == 0 ? 0.0f : -0.0f;
  }
  direction[random.below(3)] = random.symmetric();
  const float t_near = random.below(2) == 0 ? 0.0f : std::fabs(scale * random.symmetric());
  const float t_far = random.below(2) == 0 ? kInfinity : t_near + 3 * scale;
  return ray_of(origin, direction, t_near, t_far);
}

TEST(InstanceBoxes, AreEnteredAsInDouble) {
  Random random(1);
  for (const float scale : {1e-9f, 1e-3f, 1.0f, 1e6f, 1e18f}) {
    for (uint32_t count = 1; count <= kMostInstanceBoxes; ++count) {
      std::vector<RTCBounds> bounds;
      for (uint32_t i = 0; i < count; ++i) bounds.push_back(random_box(random, scale));
      for (int i = 0; i < 100; ++i) {
        expect_like_reference(bounds, random_ray(random, scale, bounds));
      }
    }
  }
}

TEST(InstanceBoxes, ThatAreEmptyAreNeverEntered) {
  const RTCBounds empty = {kInfinity,  kInfinity,  kInfinity,  0,
                           -kInfinity, -kInfinity, -kInfinity, 0};
  InstanceBoxes boxes;
  boxes.set(std::vector<RTCBounds>(kMostInstanceBoxes, empty));
  for (int signs = 0; signs < 27; ++signs) {
    const float direction[3] = {static_cast<float>(signs % 3 - 1),
                                static_cast<float>(signs / 3 % 3 - 1),
                                static_cast<float>(signs / 9 - 1)};
    alignas(16) float entry[kMostInstanceBoxes];
    EXPECT_EQ(boxes.enter(ray_of({0, 0, 0}, direction, 0, kInfinity), entry), 0u) << signs;
  }
}

// Directions whose reciprocal is out of range, and sides at the limits of coordinates.
TEST(InstanceBoxes, AtTheEndsOfTheRange) {
  constexpr float kEnd = 1.8e18f;
  const std::vector<RTCBounds> bounds = {{-kEnd, -kEnd, -kEnd, 0, kEnd, kEnd, kEnd, 0},
                                         {kEnd / 2, -1, -1, 0, kEnd, 1, 1, 0},
                                         {1, -1, -1, 0, 2, 1, 1, 0},
                                         {-2, -1, -1, 0, -1, 1, 1, 0}};
  for (const float x : {1e-38f, 1e-20f, 1e-3f, 1.0f, 1e18f}) {
    for (const float side : {0.0f, -0.0f, 1e-38f, -1e-38f, 1e-42f}) {
      InstanceBoxes boxes;
      boxes.set(bounds);
      alignas(16) float entry[kMostInstanceBoxes];
      const EnteredBoxes entered =
          boxes.enter(ray_of({0, 0, 0}, {x, side, side}, 0, kInfinity), entry);
      if (std::fabs(side) < 1e-6f * x) {
        EXPECT_EQ(entered & 5u, 5u) << x << ", " << side;
      }
      EXPECT_EQ(entered & 9u, 1u) << x << ", " << side;
    }
  }
}

// The same instances as a list of boxes and, padded with others that no ray sees, as Embree's tree.
TEST(InstanceBoxes, GiveTheHitsOfATree) {
  Harness h(2);
  h.use_standard_pipeline();
  Random random(2);
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  for (uint32_t i = 0; i < 8; ++i) {
    GeometryInput input;
    for (uint32_t corner = 0; corner < 60; ++corner) {
      input.vertices.push_back({random.symmetric(), random.symmetric(), random.symmetric()});
    }
    input.flags = i % 2 == 0 ? kOpaque : kNonOpaque;
    const auto level = h.bottom_level({input});
    for (int copy = 0; copy < 4; ++copy) {
      auto instance = instance_of(level);
      for (int row = 0; row < 3; ++row) instance.Transform[row][3] = 2 * random.symmetric();
      instances.push_back(instance);
    }
  }
  ASSERT_EQ(instances.size(), kMostInstanceBoxes);
  const uint64_t list = h.top_level(instances);
  auto unseen = instances.front();
  unseen.InstanceMask = 0;
  instances.push_back(unseen);
  const uint64_t tree = h.top_level(instances);

  std::vector<Ray> rays[2];
  for (int i = 0; i < 3000; ++i) {
    Ray ray = ray_along_z(list);
    ray.ray = {{3 * random.symmetric(), 3 * random.symmetric(), 3 * random.symmetric()},
               0.0f,
               {random.symmetric(), random.symmetric(), random.symmetric()},
               10.0f};
    if (i % 3 == 0) ray.ray_flags = 0x4 | 0x8;  // accept the first hit, skip its shader
    rays[0].push_back(ray);
    ray.acceleration_structure = tree;
    rays[1].push_back(ray);
  }
  const auto of_list = h.trace(rays[0]);
  const auto of_tree = h.trace(rays[1]);
  uint32_t hits = 0;
  for (size_t i = 0; i < of_list.size(); ++i) {
    ASSERT_EQ(of_list[i].end, of_tree[i].end) << i;
    if (of_list[i].end != End::kClosestHit) continue;
    ++hits;
    EXPECT_EQ(of_list[i].values.t_current, of_tree[i].values.t_current) << i;
    EXPECT_EQ(of_list[i].values.instance_index, of_tree[i].values.instance_index) << i;
    EXPECT_EQ(of_list[i].values.primitive_index, of_tree[i].values.primitive_index) << i;
  }
  EXPECT_GT(hits, rays[0].size() / 5);
}

}  // namespace
}  // namespace kaamos::embree::testing
