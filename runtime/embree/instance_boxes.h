// SPDX-License-Identifier: MIT
//
// The instances of a small top level as a list of boxes instead of a tree. A ray is tested against
// all of them, four at a time, and goes on to those that it enters without a callback in between;
// rays that are traced together are tested against one box after another. Numbers: README.md.
#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "kaamos/shader/abi.h"
#include "runtime/embree/embree_shim.h"
#include "runtime/embree/simd.h"

namespace kaamos::embree {

inline constexpr uint32_t kMostInstanceBoxes = 32;

// The boxes that a ray enters, one bit each.
using EnteredBoxes = uint32_t;

// The points where the ray enters them, `stride` floats from box to box. Undefined for boxes that
// it does not enter.
template <uint32_t stride>
struct BoxEntries {
  float operator[](uint32_t box) const { return first[box * stride]; }
  const float* first;
};

// Calls visit(index of a box) for each box that the ray reaches, in the order of entry (on a tie
// the lower index first). A visit may shorten the ray.
template <uint32_t stride, typename Visit>
void visit_entered(EnteredBoxes boxes, BoxEntries<stride> entry, const RTCRay& ray, Visit visit) {
  while (boxes != 0) {
    auto first = static_cast<uint32_t>(std::countr_zero(boxes));
    for (EnteredBoxes others = boxes & (boxes - 1); others != 0; others &= others - 1) {
      const auto other = static_cast<uint32_t>(std::countr_zero(others));
      if (entry[other] < entry[first]) first = other;
    }
    boxes &= ~(EnteredBoxes{1} << first);
    if (entry[first] > ray.tfar) return;  // and so are all others
    visit(first);
  }
}

class InstanceBoxes {
 public:
  // At most kMostInstanceBoxes. A box with lower above upper is never entered.
  void set(std::span<const RTCBounds> bounds) {
    fours_.assign((bounds.size() + 3) / 4, Four{});
    boxes_.resize(bounds.size());
    all_ = 0;
    for (size_t i = 0; i < bounds.size(); ++i) {
      const RTCBounds& b = bounds[i];
      const float lower[3] = {b.lower_x, b.lower_y, b.lower_z};
      const float upper[3] = {b.upper_x, b.upper_y, b.upper_z};
      const bool is_empty = !(b.lower_x <= b.upper_x);
      if (!is_empty) all_ |= 1u << i;
      for (int axis = 0; axis < 3; ++axis) {
        float* sides = boxes_[i].sides[axis];
        sides[0] = lower[axis] - (is_empty ? 0 : room_of(lower[axis]));
        sides[1] = upper[axis] + (is_empty ? 0 : room_of(upper[axis]));
        for (int side = 0; side < 2; ++side) fours_[i / 4].sides[axis][side][i % 4] = sides[side];
      }
    }
  }

  bool empty() const { return fours_.empty(); }

  // visit_entered for the boxes that the ray enters.
  template <typename Visit>
  void for_each_entered(const RTCRay& ray, Visit visit) const {
    alignas(16) float entry[kMostInstanceBoxes];
    const EnteredBoxes boxes = enter(ray, entry);
    visit_entered(boxes, BoxEntries<1>{entry}, ray, visit);
  }

  // Boxes are closed, and so is the interval from tnear, at least 0, to tfar. `ray` and `entry` are
  // aligned to 16 bytes. Rounding never loses a box that the ray enters.
  EnteredBoxes enter(const RTCRay& ray, float* entry) const {
    const __m128 origin = _mm_load_ps(&ray.org_x);  // w: tnear
    const __m128 slope = reciprocal(_mm_load_ps(&ray.dir_x));
    const int backwards = _mm_movemask_ps(slope);
    const int near_x = backwards & 1;
    const int near_y = (backwards >> 1) & 1;
    const int near_z = (backwards >> 2) & 1;
    const __m128 origin_x = _mm_shuffle_ps(origin, origin, _MM_SHUFFLE(0, 0, 0, 0));
    const __m128 origin_y = _mm_shuffle_ps(origin, origin, _MM_SHUFFLE(1, 1, 1, 1));
    const __m128 origin_z = _mm_shuffle_ps(origin, origin, _MM_SHUFFLE(2, 2, 2, 2));
    const __m128 slope_x = _mm_shuffle_ps(slope, slope, _MM_SHUFFLE(0, 0, 0, 0));
    const __m128 slope_y = _mm_shuffle_ps(slope, slope, _MM_SHUFFLE(1, 1, 1, 1));
    const __m128 slope_z = _mm_shuffle_ps(slope, slope, _MM_SHUFFLE(2, 2, 2, 2));
    const __m128 t_near = _mm_shuffle_ps(origin, origin, _MM_SHUFFLE(3, 3, 3, 3));
    const __m128 t_far = _mm_set1_ps(ray.tfar);
    const __m128 sooner = _mm_set1_ps(kSooner);
    const __m128 later = _mm_set1_ps(kLater);
    const auto t_of = [](const float* side, __m128 from, __m128 over) {
      return _mm_mul_ps(_mm_sub_ps(_mm_load_ps(side), from), over);
    };
    EnteredBoxes entered = 0;
    uint32_t first = 0;
    for (const Four& four : fours_) {
      const __m128 in_x = t_of(four.sides[0][near_x], origin_x, slope_x);
      const __m128 in_y = t_of(four.sides[1][near_y], origin_y, slope_y);
      const __m128 in_z = t_of(four.sides[2][near_z], origin_z, slope_z);
      const __m128 out_x = t_of(four.sides[0][near_x ^ 1], origin_x, slope_x);
      const __m128 out_y = t_of(four.sides[1][near_y ^ 1], origin_y, slope_y);
      const __m128 out_z = t_of(four.sides[2][near_z ^ 1], origin_z, slope_z);
      const __m128 in =
          _mm_mul_ps(_mm_max_ps(_mm_max_ps(in_x, in_y), _mm_max_ps(in_z, t_near)), sooner);
      const __m128 out =
          _mm_mul_ps(_mm_min_ps(_mm_min_ps(out_x, out_y), _mm_min_ps(out_z, t_far)), later);
      _mm_store_ps(entry + first, in);
      entered |= static_cast<uint32_t>(_mm_movemask_ps(_mm_cmple_ps(in, out))) << first;
      first += 4;
    }
    return entered & all_;
  }

  // For testing rays against one box after another [lane_rays.cpp]: the sides of all boxes, and
  // which boxes can be entered.
  struct Box {
    float sides[3][2];  // by axis; lower, upper
  };
  const std::vector<Box>& boxes() const { return boxes_; }
  EnteredBoxes all() const { return all_; }

  // Difference, reciprocal and product are each off by at most half an ulp: 3 * 2^-24 in all.
  static constexpr float kSooner = 1 - 2 * FLT_EPSILON;
  static constexpr float kLater = 1 + 2 * FLT_EPSILON;

 private:
  struct alignas(16) Four {
    float sides[3][2][4];  // by axis; lower, upper
  };

  // A ray that runs within a side counts as inside the box, even where its slope is infinite and a
  // distance of 0 would decide nothing.
  static float room_of(float side) { return std::fabs(side) * FLT_EPSILON + 1e-25f; }

  // Clamped to be finite, so that no product is NaN. For a ray parallel to an axis, its product
  // with any distance along that axis is infinite or nearly so.
  static __m128 reciprocal(__m128 direction) {
    const __m128 sign_bit = _mm_set1_ps(-0.0f);
    const __m128 size = _mm_max_ps(_mm_andnot_ps(sign_bit, direction), _mm_set1_ps(FLT_MIN));
    return _mm_or_ps(_mm_div_ps(_mm_set1_ps(1.0f), size), _mm_and_ps(sign_bit, direction));
  }

  std::vector<Four> fours_;
  std::vector<Box> boxes_;
  EnteredBoxes all_ = 0;
};

}  // namespace kaamos::embree
