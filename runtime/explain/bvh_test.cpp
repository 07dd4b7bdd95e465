// SPDX-License-Identifier: MIT
#include "runtime/explain/bvh.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace kaamos::explain {
namespace {

// Visits every box that the forward half of the ray hits, compared with a test of each box.
TEST(Bvh, FindsWhatATestOfEachBoxFinds) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10, 10), size(0, 4);
  std::vector<Box> boxes(500);
  for (size_t i = 0; i < boxes.size(); ++i) {
    if (i % 50 == 0) continue;  // empty
    for (int axis = 0; axis < 3; ++axis) {
      boxes[i].lower[axis] = place(random);
      boxes[i].upper[axis] = boxes[i].lower[axis] + size(random);
    }
  }
  Bvh bvh;
  bvh.build(boxes);
  size_t hits = 0;
  for (int r = 0; r < 200; ++r) {
    Ray ray = {{place(random), place(random), place(random)},
               {place(random), place(random), place(random)}};
    if (r % 3 == 0) ray.direction[r % 2] = 0;
    std::set<uint32_t> found;
    bvh.visit(ray, [&](uint32_t i) { found.insert(i); });
    for (uint32_t i = 0; i < boxes.size(); ++i) {
      double enter, leave;
      if (boxes[i].empty() || !clip(ray, boxes[i], enter, leave) || leave < 0) continue;
      EXPECT_TRUE(found.count(i)) << "ray " << r << ", box " << i;
      ++hits;
    }
  }
  EXPECT_GT(hits, 100u);
}

TEST(Bvh, EqualBoxesAndNoBoxesAreFine) {
  Bvh bvh;
  bvh.build({});
  const Ray ray = {{0.5, 0.5, -1}, {0, 0, 1}};
  size_t count = 0;
  bvh.visit(ray, [&](uint32_t) { ++count; });
  EXPECT_EQ(count, 0u);
  Box unit;
  for (int axis = 0; axis < 3; ++axis) {
    unit.lower[axis] = 0;
    unit.upper[axis] = 1;
  }
  bvh.build(std::vector<Box>(1000, unit));
  bvh.visit(ray, [&](uint32_t) { ++count; });
  EXPECT_EQ(count, 1000u);
}

}  // namespace
}  // namespace kaamos::explain
