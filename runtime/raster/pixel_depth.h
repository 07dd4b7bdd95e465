// SPDX-License-Identifier: MIT
//
// Depth of pixels: the triangle's plane, conversion to the target's format, comparison.
// [D3D11.3: 15.6.1, 17.10, 17.11]
#pragma once

#include "runtime/raster/coverage.h"
#include "runtime/raster/draw_plan.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

// Corners of blocks in a tile, in subpixels.
inline constexpr int kBlockColumns = kTileSize / 4;
inline constexpr int kBlockRows = kTileSize / 2;
struct BlockCorners {
  double x[kBlockColumns], y[kBlockRows];
  constexpr BlockCorners() : x(), y() {
    for (int i = 0; i < kBlockColumns; ++i) x[i] = 4 * kSubpixels * i;
    for (int i = 0; i < kBlockRows; ++i) y[i] = 2 * kSubpixels * i;
  }
};
inline constexpr BlockCorners kBlockCorners;
// Coordinates of a block's pixels in subpixels, from the first pixel's corner.
inline constexpr double kBlockCenterX[8] = {128, 384, 128, 384, 640, 896, 640, 896};
inline constexpr double kBlockCenterY[8] = {128, 128, 384, 384, 128, 128, 384, 384};

// z of a pixel depends on the triangle and the pixel only, not on the tile or block it is found in:
// one rounding to float at the end.
class DepthPlane {
 public:
  KAAMOS_INLINE void begin(const Triangle& t, int32_t x, int32_t y) {
    x_ = static_cast<double>(x * kSubpixels - t.x[0]);
    y_ = static_cast<double>(y * kSubpixels - t.y[0]);
    z_ = static_cast<double>(t.z[0]);
    dz_dx_ = t.dz_dx;
    dz_dy_ = t.dz_dy;
    sliver_ = (t.flags & kSliver) != 0;
    if (sliver_) begin_sliver(t);
  }

  // The part that all blocks of a row of the tile have in common.
  KAAMOS_INLINE Doubles8 at_row(int32_t block_y) const {
    return doubles(z_) + doubles(dz_dy_) * row_y(block_y);
  }
  KAAMOS_INLINE Floats8 at_block(const Doubles8& row, int32_t block_x, int32_t block_y) const {
    const Doubles8 x = doubles(x_ + kBlockCorners.x[block_x]) + load_doubles(kBlockCenterX);
    if (sliver_) return at_sliver(x, row_y(block_y));
    return to_floats(row + doubles(dz_dx_) * x);
  }

 private:
  KAAMOS_INLINE Doubles8 row_y(int32_t block_y) const {
    return doubles(y_ + kBlockCorners.y[block_y]) + load_doubles(kBlockCenterY);
  }
  // From the exact values of two edges instead.
  void begin_sliver(const Triangle& t) {
    const double dx1 = t.x[1] - t.x[0], dy1 = t.y[1] - t.y[0];
    const double dx2 = t.x[2] - t.x[0], dy2 = t.y[2] - t.y[0];
    const double area = dx1 * dy2 - dx2 * dy1;
    edge_[0][0] = dy2;
    edge_[0][1] = -dx2;
    edge_[1][0] = -dy1;
    edge_[1][1] = dx1;
    weight_[0] = (static_cast<double>(t.z[1]) - z_) / area;
    weight_[1] = (static_cast<double>(t.z[2]) - z_) / area;
  }
  Floats8 at_sliver(const Doubles8& x, const Doubles8& y) const {
    const Doubles8 first = doubles(edge_[0][0]) * x + doubles(edge_[0][1]) * y;
    const Doubles8 second = doubles(edge_[1][0]) * x + doubles(edge_[1][1]) * y;
    return to_floats(doubles(z_) + first * doubles(weight_[0]) + second * doubles(weight_[1]));
  }

  double x_, y_;  // of the tile's corner, from vertex 0
  double z_, dz_dx_, dz_dy_;
  bool sliver_;
  double edge_[2][2];
  double weight_[2];
};

// Bits of DrawPlan::depth_func.
inline constexpr uint32_t kPassLess = 1, kPassEqual = 2, kPassGreater = 4;
inline constexpr uint32_t kAnyFunc = ~0u;  // the constructor's

// Tests and writes words of a tile's depth.
template <DepthKind kKind, uint32_t kFunc = kAnyFunc>
class DepthTest {
 public:
  KAAMOS_INLINE DepthTest(uint32_t func, float low, float high)
      : less_(every_lane_if((func & kPassLess) != 0)),
        equal_(every_lane_if((func & kPassEqual) != 0)),
        greater_(every_lane_if((func & kPassGreater) != 0)),
        unequal_(every_lane_if((func & kPassLess) != 0 && (func & kPassGreater) != 0)),
        low_(splat(low)),
        high_(splat(high)) {}

  // The lanes of `active` that pass; writes theirs if `write`.
  KAAMOS_INLINE lanes run(uint32_t* words, const Floats8& z, const lanes& active,
                          bool write) const {
    const Floats8 clamped = smaller(larger(z, low_), high_);
    lanes pass;
    if constexpr (kKind == DepthKind::kFloat32) {
      const Floats8 stored = load<float>(words);
      pass = compare(clamped, stored) & active;
      if (write) store(words, choose(pass, clamped, stored));
    } else {
      const Ints8 old = load<int32_t>(words);
      const Ints8 value = convert(clamped);
      pass = compare(value, old & splat(kDepthBits)) & active;
      if (write) store(words, choose(pass, value | (old & splat(~kDepthBits)), old));
    }
    return pass;
  }
  // The same for two quads that need not be side by side.
  KAAMOS_INLINE lanes run(uint32_t* first, uint32_t* second, const Floats8& z, const lanes& active,
                          bool write) const {
    uint32_t both[8];
    __builtin_memcpy(both, first, 16);
    __builtin_memcpy(both + 4, second, 16);
    const lanes pass = run(both, z, active, write);
    if (write) {
      __builtin_memcpy(first, both, 16);
      __builtin_memcpy(second, both + 4, 16);
    }
    return pass;
  }

 private:
  static constexpr int32_t kDepthBits = kKind == DepthKind::kUnorm16 ? 0xFFFF : 0xFFFFFF;

  KAAMOS_INLINE static Ints8 convert(const Floats8& z) {
    if constexpr (kKind == DepthKind::kUnorm16) {
      return to_ints(z * splat(65535.0f) + splat(0.5f));
    } else {  // floats have not enough bits for the sum
      return to_ints(to_doubles(z) * doubles(16777215.0) + doubles(0.5));
    }
  }
  // If either is NaN, only functions that pass for both less and greater pass.
  template <class T>
  KAAMOS_INLINE lanes compare(const wide<T>& z, const wide<T>& stored) const {
    if constexpr (kFunc == kPassLess) return less(z, stored);
    if constexpr (kFunc == kPassGreater) return less(stored, z);
    if constexpr (kFunc == (kPassLess | kPassEqual)) return less_or_equal(z, stored);
    if constexpr (kFunc == (kPassGreater | kPassEqual)) return less_or_equal(stored, z);
    const lanes same = equal(z, stored);
    return (less(z, stored) & less_) | (less(stored, z) & greater_) | (same & equal_) |
           (~same & unequal_);
  }

  lanes less_, equal_, greater_, unequal_;
  Floats8 low_, high_;
};

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
