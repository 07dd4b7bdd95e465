// SPDX-License-Identifier: MIT
//
// Computes what draws must do, pixel by pixel and as the rules are written: integers for coverage,
// long doubles for the rest. Triangles are in front of the eye and are not cut.
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

  bool is_in_target() const;
  bool covers(uint32_t x, uint32_t y) const;
  void each_pixel(const std::function<void(uint32_t x, uint32_t y)>& visit) const;
  // At the centre of a pixel, from the rounded corners.
  long double depth(uint32_t x, uint32_t y) const;
  // The first of value: linear or, without perspective, linear on the screen.
  long double value(uint32_t x, uint32_t y, bool perspective) const;
  // In pixels, from the centre of one to the nearest line through two corners.
  long double distance_to_edges(uint32_t x, uint32_t y) const;
  std::string text() const;  // its corners
  // The largest differences that a backend may have from these at a pixel. [RAS-70, RAS-73]
  struct Bounds {
    long double depth, value, on_screen;
  };
  Bounds bounds(uint32_t x, uint32_t y, bool vulkan) const;

 private:
  int64_t edge(int from, int64_t x, int64_t y) const;
  void weights(uint32_t x, uint32_t y, long double out[3]) const;
  // |df/dx| + |df/dy| of a pixel, of what is linear on the screen.
  long double slope_of(const long double values[3]) const;

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

// A triangle of which parts may be behind the eye, without rounding of corners.
class ProjectedTriangle {
 public:
  // Corners are multiples of 1/256 from -8 to 8.
  ProjectedTriangle(uint32_t size, const Corner* corners);

  struct Pixel {
    bool inside = false;
    bool near_border = false;  // so near that rounding of corners may decide
    double depth = 0, value = 0;
    double depth_bound = 0, value_bound = 0;
  };
  Pixel at(uint32_t x, uint32_t y) const;

 private:
  // a x + b y + c at pixel centres.
  struct Plane {
    double a, b, c;
    double at(double x, double y) const { return a * x + b * y + c; }
    double slope() const;
  };
  Plane combine(const double factors[3]) const;

  bool has_area_ = false;
  Plane weights_[3] = {};  // barycentrics over w
  Plane inv_w_ = {}, depth_ = {}, value_over_w_ = {};
};

// Random triangles with x, y, z and w from -8 to 8, at least one w above 0.
std::vector<Corner> eye_triangles(uint32_t count, std::mt19937& random);

}  // namespace kaamos::conformance
