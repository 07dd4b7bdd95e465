// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/dispatch_split.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace kaamos::vulkan {
namespace {

TEST(DispatchSplit, WhatFitsIsOnePart) {
  const auto parts = split_grid({8192, 8192, 1}, {{1u << 26, 1u << 26, 1u << 26}, 1u << 26});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0], (GridPart{{0, 0, 0}, {8192, 8192, 1}}));
}

TEST(DispatchSplit, RowsStayWhole) {
  const auto parts = split_grid({8192, 8193, 1}, {{UINT32_MAX, UINT32_MAX, UINT32_MAX}, 1u << 26});
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0], (GridPart{{0, 0, 0}, {8192, 8192, 1}}));
  EXPECT_EQ(parts[1], (GridPart{{0, 8192, 0}, {8192, 1, 1}}));
}

TEST(DispatchSplit, TheLargestGridOfDxr) {
  const auto parts = split_grid({1u << 30, 1, 1}, {{1u << 26, 1u << 26, 1u << 26}, 1u << 26});
  ASSERT_EQ(parts.size(), 16u);
  EXPECT_EQ(parts[15], (GridPart{{15u << 26, 0, 0}, {1u << 26, 1, 1}}));
}

TEST(DispatchSplit, NothingIsNoParts) {
  for (int axis = 0; axis < 3; ++axis) {
    std::array<uint32_t, 3> grid = {3, 4, 5};
    grid[axis] = 0;
    EXPECT_TRUE(split_grid(grid, {}).empty());
  }
}

TEST(DispatchSplit, EveryCellOnceAndWithinTheLimits) {
  std::mt19937 random(7);
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(1 + random() % n); };
  for (int i = 0; i < 200; ++i) {
    const std::array<uint32_t, 3> grid = {below(20), below(12), below(6)};
    const GridLimits limits = {{below(24), below(8), below(4)}, below(60)};
    std::map<std::array<uint32_t, 3>, int> cells;
    for (const GridPart& part : split_grid(grid, limits)) {
      EXPECT_LE(uint64_t{part.size[0]} * part.size[1] * part.size[2], limits.cells);
      for (int axis = 0; axis < 3; ++axis) EXPECT_LE(part.size[axis], limits.size[axis]);
      for (uint32_t z = 0; z < part.size[2]; ++z) {
        for (uint32_t y = 0; y < part.size[1]; ++y) {
          for (uint32_t x = 0; x < part.size[0]; ++x) {
            ++cells[{part.base[0] + x, part.base[1] + y, part.base[2] + z}];
          }
        }
      }
    }
    ASSERT_EQ(cells.size(), size_t{grid[0]} * grid[1] * grid[2]);
    for (const auto& [cell, count] : cells) {
      ASSERT_EQ(count, 1);
      for (int axis = 0; axis < 3; ++axis) ASSERT_LT(cell[axis], grid[axis]);
    }
  }
}

}  // namespace
}  // namespace kaamos::vulkan
