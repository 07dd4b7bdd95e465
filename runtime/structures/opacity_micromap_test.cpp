// SPDX-License-Identifier: MIT
#include "runtime/structures/opacity_micromap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace kaamos::runtime {
namespace {

struct Point {
  double u, v;
};
using Triangle = std::array<Point, 3>;

Point between(Point a, Point b) {
  return {(a.u + b.u) / 2, (a.v + b.v) / 2};
}

// The micro-triangles in the order of DXR's figures, by their definition: a triangle entered at a
// and left at c.
void visit(Point a, Point b, Point c, uint32_t level, std::vector<Triangle>& out) {
  if (level == 0) return out.push_back({a, b, c});
  const Point ab = between(a, b), bc = between(b, c), ca = between(c, a);
  visit(a, ab, ca, level - 1, out);
  visit(ca, bc, ab, level - 1, out);
  visit(ab, b, bc, level - 1, out);
  visit(bc, ca, c, level - 1, out);
}

uint32_t index_at(Point p, uint32_t level) {
  return micro_triangle_index(static_cast<float>(p.u), static_cast<float>(p.v), level);
}

TEST(OpacityMicromap, OMM_28_TheOrderIsThatOfTheFigures) {
  for (uint32_t level = 0; level <= 8; ++level) {
    std::vector<Triangle> triangles;
    visit({0, 0}, {1, 0}, {0, 1}, level, triangles);
    ASSERT_EQ(triangles.size(), size_t{1} << 2 * level);
    for (uint32_t i = 0; i < triangles.size(); ++i) {
      const auto& [a, b, c] = triangles[i];
      const Point centre = {(a.u + b.u + c.u) / 3, (a.v + b.v + c.v) / 3};
      ASSERT_EQ(index_at(centre, level), i) << "level " << level;
    }
  }
}

TEST(OpacityMicromap, OMM_30_KnownPlaces) {
  EXPECT_EQ(micro_triangle_index(0.1f, 0.2f, 3), 4u);
  EXPECT_EQ(micro_triangle_index(0.3f, 0.3f, 4), 81u);
  EXPECT_EQ(micro_triangle_index(0, 0, 5), 0u);
  EXPECT_EQ(micro_triangle_index(1, 0, 5), 682u);
  EXPECT_EQ(micro_triangle_index(0, 1, 5), 1023u);
  EXPECT_EQ(micro_triangle_index(1 / 3.0f, 1 / 3.0f, 1), 1u);
  for (uint32_t level = 1; level <= kMaxSubdivisionLevel; ++level) {
    EXPECT_EQ(micro_triangle_index(1, 0, level), (2 * (1u << 2 * level) - 2) / 3) << level;
    EXPECT_EQ(micro_triangle_index(0, 1, level), (1u << 2 * level) - 1) << level;
  }
}

TEST(OpacityMicromap, OMM_31_LevelsAreHierarchical) {
  for (uint32_t i = 0; i < 20000; ++i) {
    const double u = (i * 7919 % 20000 + 0.37) / 20000;
    const double v = (1 - u) * (i * 104729 % 20000 + 0.41) / 20000;
    for (uint32_t level = 1; level <= 10; ++level) {
      ASSERT_EQ(index_at({u, v}, level) >> 2, index_at({u, v}, level - 1)) << u << ", " << v;
    }
  }
}

TEST(OpacityMicromap, OMM_44_NumbersThatAreNoBarycentricsStayInside) {
  for (const float u : {-1.0f, 0.0f, 0.5f, 1.0f, 2.0f, std::nanf(""), 1e30f}) {
    for (const float v : {-1.0f, 0.0f, 0.5f, 1.0f, 2.0f, std::nanf(""), -1e30f}) {
      for (const uint32_t level : {0u, 1u, 5u, 12u}) {
        EXPECT_LT(micro_triangle_index(u, v, level), 1u << 2 * level) << u << ", " << v;
      }
    }
  }
}

TEST(OpacityMicromap, OMM_04_BitsAreReadFromTheLowest) {
  MicromapArray array;
  array.add(1, MicromapFormat::kTwoStates, std::array<uint8_t, 1>{0x05});
  array.add(1, MicromapFormat::kFourStates, std::array<uint8_t, 1>{0xE4});
  for (uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(array.state(0, i), i % 2 == 0 ? MicromapState::kOpaque : MicromapState::kTransparent);
    EXPECT_EQ(static_cast<uint32_t>(array.state(1, i)), i);
  }
  EXPECT_EQ(array.state_at(0, 1 / 3.0f, 1 / 3.0f), MicromapState::kTransparent);
}

TEST(OpacityMicromap, OMM_05_Sizes) {
  const auto bytes = [](uint32_t level) {
    return std::pair(micromap_bytes(level, MicromapFormat::kTwoStates),
                     micromap_bytes(level, MicromapFormat::kFourStates));
  };
  using Pair = std::pair<uint64_t, uint64_t>;
  EXPECT_EQ(bytes(0), Pair(1, 1));
  EXPECT_EQ(bytes(1), Pair(1, 1));
  EXPECT_EQ(bytes(2), Pair(2, 4));
  EXPECT_EQ(bytes(3), Pair(8, 16));
  EXPECT_EQ(bytes(5), Pair(128, 256));
  EXPECT_EQ(bytes(12), Pair(2u << 20, 4u << 20));
}

TEST(OpacityMicromap, OMM_36_TwoStatesAreTheLowBit) {
  EXPECT_EQ(as_two_states(MicromapState::kUnknownTransparent), MicromapState::kTransparent);
  EXPECT_EQ(as_two_states(MicromapState::kUnknownOpaque), MicromapState::kOpaque);
  EXPECT_EQ(as_two_states(MicromapState::kOpaque), MicromapState::kOpaque);
}

}  // namespace
}  // namespace kaamos::runtime
