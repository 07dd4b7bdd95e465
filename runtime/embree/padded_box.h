// SPDX-License-Identifier: MIT
//
// The box of a procedural primitive as the traversal sees it. Embree tests the box of a leaf. In
// trees that can be updated or are built fast a leaf may hold several primitives, so each is tested
// again before its shader runs. Where each has a leaf of its own it is not: that would take 0.94 of
// the speed (README.md).
#pragma once

#include <limits>

#include "runtime/embree/embree_shim.h"
#include "runtime/embree/simd.h"
#include "runtime/structures/build_inputs.h"

namespace kaamos::embree {

struct PaddedBox {
  __m128 lower;  // three lanes; the fourth has no meaning
  __m128 upper;

  static PaddedBox of(const rtapi::RaytracingAabb& box) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const runtime::PaddedBounds bounds = runtime::padded_bounds(box);
    // An inactive box is inverted: nothing meets it, and Embree leaves it out.
    if (!bounds.active) return {_mm_set1_ps(kInfinity), _mm_set1_ps(-kInfinity)};
    return {_mm_setr_ps(bounds.lower[0], bounds.lower[1], bounds.lower[2], 0),
            _mm_setr_ps(bounds.upper[0], bounds.upper[1], bounds.upper[2], 0)};
  }

  bool active() const { return _mm_cvtss_f32(lower) <= _mm_cvtss_f32(upper); }

  // Returns whether the ray passes the box between its tnear and tfar, both included. Never false
  // for one that does: the relative error of each t is at most 3 half ulps, since differences of
  // floats and their products are rounded once.
  bool meets(const RTCRay& ray) const {
    const __m128 origin = _mm_load_ps(&ray.org_x);
    const __m128 direction = _mm_load_ps(&ray.dir_x);
    const __m128 reciprocal = _mm_div_ps(_mm_set1_ps(1), direction);
    const __m128 to_lower = _mm_mul_ps(_mm_sub_ps(lower, origin), reciprocal);
    const __m128 to_upper = _mm_mul_ps(_mm_sub_ps(upper, origin), reciprocal);
    const __m128 backwards = _mm_castsi128_ps(_mm_srai_epi32(_mm_castps_si128(direction), 31));
    // A ray that lies in a face gets a NaN there, which the maximum and the minimum ignore because
    // it is their first operand.
    const __m128 enter = select(backwards, to_upper, to_lower);
    const __m128 leave = select(backwards, to_lower, to_upper);
    const float near = largest(enter, ray.tnear);
    const float far = smallest(leave, ray.tfar);
    return near <= far * (1 + 8 * std::numeric_limits<float>::epsilon());
  }

 private:
  static __m128 select(__m128 mask, __m128 if_set, __m128 if_clear) {
    return _mm_or_ps(_mm_and_ps(mask, if_set), _mm_andnot_ps(mask, if_clear));
  }
  template <int lane>
  static __m128 splat(__m128 v) {
    return _mm_shuffle_ps(v, v, _MM_SHUFFLE(lane, lane, lane, lane));
  }
  static float largest(__m128 v, float start) {
    __m128 value = _mm_max_ss(v, _mm_set_ss(start));
    value = _mm_max_ss(splat<1>(v), value);
    return _mm_cvtss_f32(_mm_max_ss(splat<2>(v), value));
  }
  static float smallest(__m128 v, float start) {
    __m128 value = _mm_min_ss(v, _mm_set_ss(start));
    value = _mm_min_ss(splat<1>(v), value);
    return _mm_cvtss_f32(_mm_min_ss(splat<2>(v), value));
  }
};

}  // namespace kaamos::embree
