// SPDX-License-Identifier: MIT
//
// What draws must do, pixel by pixel and as the rules are written: integers for coverage, long
// doubles for the rest. Triangles are in front of the eye and are not cut.
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

class ExactTriangle {
 public:
  // Three corners whose places on the screen are exact floats. Covers only pixels of the screen.
  ExactTriangle(const Screen& screen, const Corner* corners);

  bool has_area() const { return area_ != 0; }
  bool covers(uint32_t x, uint32_t y) const;
  void each_pixel(const std::function<void(uint32_t x, uint32_t y)>& visit) const;
  // At the centre of a pixel, from the rounded corners.
  long double depth(uint32_t x, uint32_t y) const;
  // The first of value: linear or, without perspective, linear on the screen.
  long double value(uint32_t x, uint32_t y, bool perspective) const;
  // Steepness of depth: |dz/dx| + |dz/dy| of a pixel.
  long double slope() const;
  // Of the longest side to the height above it: 1 and more.
  long double thinness() const;

 private:
  int64_t edge(int from, int64_t x, int64_t y) const;
  void weights(uint32_t x, uint32_t y, long double out[3]) const;

  uint32_t size_;
  int64_t x_[3], y_[3];  // in 1/256 pixels
  long double z_[3], w_[3], value_[3];
  int64_t area_;
};

enum class GridKind {
  kSmall,    // a few pixels
  kMedium,   // a part of the target
  kHuge,     // thousands of pixels
  kSliver,   // long and thin
  kCenters,  // corners at centres of pixels
};

// Random triangles. Corners are multiples of 1/2048 pixel, and w is a power of two, so that any
// order of operations gives the same place on the screen. z and value[0] are from 0 to 1.
std::vector<Corner> grid_triangles(const Screen& screen, GridKind kind, uint32_t count,
                                   std::mt19937& random);

}  // namespace kaamos::conformance
