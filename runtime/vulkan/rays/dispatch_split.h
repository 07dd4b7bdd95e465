// SPDX-License-Identifier: MIT
//
// Splits a grid that a device cannot run in one piece.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace kaamos::vulkan {

struct GridPart {
  std::array<uint32_t, 3> base = {0, 0, 0};
  std::array<uint32_t, 3> size = {0, 0, 0};
  bool operator==(const GridPart&) const = default;
};

struct GridLimits {
  std::array<uint64_t, 3> size = {UINT32_MAX, UINT32_MAX, UINT32_MAX};  // at least 1
  uint64_t cells = UINT64_MAX;                                          // in all, at least 1
};

inline GridLimits smaller(const GridLimits& a, const GridLimits& b) {
  GridLimits result;
  for (int axis = 0; axis < 3; ++axis) result.size[axis] = std::min(a.size[axis], b.size[axis]);
  result.cells = std::min(a.cells, b.cells);
  return result;
}

// Parts that together cover every cell once; rows stay whole as far as the limits allow. Empty for
// an empty grid.
inline std::vector<GridPart> split_grid(const std::array<uint32_t, 3>& grid,
                                        const GridLimits& limits) {
  std::array<uint32_t, 3> part;
  uint64_t cells_left = limits.cells;
  for (int axis = 0; axis < 3; ++axis) {
    part[axis] = static_cast<uint32_t>(
        std::min({uint64_t{grid[axis]}, limits.size[axis], std::max<uint64_t>(cells_left, 1)}));
    if (part[axis] == 0) return {};
    cells_left /= part[axis];
  }
  std::vector<GridPart> parts;
  for (uint64_t z = 0; z < grid[2]; z += part[2]) {
    for (uint64_t y = 0; y < grid[1]; y += part[1]) {
      for (uint64_t x = 0; x < grid[0]; x += part[0]) {
        GridPart p;
        p.base = {static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(z)};
        for (int axis = 0; axis < 3; ++axis) {
          p.size[axis] = std::min(part[axis], grid[axis] - p.base[axis]);
        }
        parts.push_back(p);
      }
    }
  }
  return parts;
}

}  // namespace kaamos::vulkan
