// SPDX-License-Identifier: MIT
//
// The instances of a small top level as a list of boxes instead of a tree: a ray is held against
// all of them, four at a time, and goes to those that it enters without a callback between.
// Numbers: README.md.
#pragma once

#include <immintrin.h>

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/embree/embree_shim.h"

namespace kaamos::embree {

inline constexpr uint32_t kMostInstanceBoxes = 32;

// The boxes that a ray enters.
struct EnteredBoxes {
  // Takes out the one that is entered first, of those with the same entry the first. There is one.
  uint32_t take_first() {
    auto first = static_cast<uint32_t>(std::countr_zero(boxes));
    for (uint32_t others = boxes & (boxes - 1); others != 0; others &= others - 1) {
      const auto other = static_cast<uint32_t>(std::countr_zero(others));
      if (entry[other] < entry[first]) first = other;
    }
    boxes &= ~(1u << first);
    return first;
  }

  uint32_t boxes;                               // a bit each
  alignas(16) float entry[kMostInstanceBoxes];  // where; of others undefined
};

class InstanceBoxes {
 public:
  // At most kMostInstanceBoxes. Those with lower above upper are never entered.
  void set(std::span<const RTCBounds> bounds) {
    fours_.assign((bounds.size() + 3) / 4, Four{});
    for (size_t i = 0; i < bounds.size(); ++i) {
      const RTCBounds& b = bounds[i];
      const float lower[3] = {b.lower_x, b.lower_y, b.lower_z};
      const float upper[3] = {b.upper_x, b.upper_y, b.upper_z};
      const bool is_empty = !(b.lower_x <= b.upper_x);
      for (int axis = 0; axis < 3; ++axis) {
        fours_[i / 4].sides[axis][0][i % 4] = lower[axis] - (is_empty ? 0 : room_of(lower[axis]));
        fours_[i / 4].sides[axis][1][i % 4] = upper[axis] + (is_empty ? 0 : room_of(upper[axis]));
      }
    }
    all_ = static_cast<uint32_t>((uint64_t{1} << bounds.size()) - 1);
  }

  bool empty() const { return fours_.empty(); }

  // Calls visit(number of a box) for each that the ray enters, the one that it enters first first,
  // as long as it gets there: a visit may shorten the ray.
  template <typename Visit>
  void for_each_entered(const RTCRay& ray, Visit visit) const {
    EnteredBoxes entered;
    enter(ray, entered);
    while (entered.boxes != 0) {
      const uint32_t box = entered.take_first();
      if (entered.entry[box] > ray.tfar) return;  // as all others are
      visit(box);
    }
  }

  // Closed boxes and the closed interval from tnear, 0 or more, to tfar; `ray` is aligned to 16
  // bytes. No box that the ray enters is left out for rounding.
  void enter(const RTCRay& ray, EnteredBoxes& entered) const {
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
    // Difference, reciprocal and product are each off by half an ulp at most: 3 * 2^-24 in all.
    const __m128 sooner = _mm_set1_ps(1 - 2 * FLT_EPSILON);
    const __m128 later = _mm_set1_ps(1 + 2 * FLT_EPSILON);
    const auto t_of = [](const float* side, __m128 from, __m128 over) {
      return _mm_mul_ps(_mm_sub_ps(_mm_load_ps(side), from), over);
    };
    entered.boxes = 0;
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
      _mm_store_ps(entered.entry + first, in);
      entered.boxes |= static_cast<uint32_t>(_mm_movemask_ps(_mm_cmple_ps(in, out))) << first;
      first += 4;
    }
    entered.boxes &= all_;
  }

 private:
  struct alignas(16) Four {
    float sides[3][2][4];  // by axis; lower, upper
  };

  // A ray within a side lies in the box, also where its slope is infinite: 0 times that says
  // nothing.
  static float room_of(float side) { return std::fabs(side) * FLT_EPSILON + 1e-25f; }

  // Finite, so that no product is NaN; times what lies beside a ray that is parallel to an axis it
  // is infinite or as good as that.
  static __m128 reciprocal(__m128 direction) {
    const __m128 sign_bit = _mm_set1_ps(-0.0f);
    const __m128 size = _mm_max_ps(_mm_andnot_ps(sign_bit, direction), _mm_set1_ps(FLT_MIN));
    return _mm_or_ps(_mm_div_ps(_mm_set1_ps(1.0f), size), _mm_and_ps(sign_bit, direction));
  }

  std::vector<Four> fours_;
  uint32_t all_ = 0;
};

}  // namespace kaamos::embree
