// SPDX-License-Identifier: MIT
#include "runtime/embree/exact_pack.h"
#include "runtime/embree/simd.h"

namespace kaamos::embree {
namespace {

struct Lanes {
  __m128d low, high;

  static Lanes load(const float* values) {
    const __m128 four = _mm_load_ps(values);
    return {_mm_cvtps_pd(four), _mm_cvtps_pd(_mm_movehl_ps(four, four))};
  }
  static Lanes all(double value) { return {_mm_set1_pd(value), _mm_set1_pd(value)}; }
};

inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return {_mm_sub_pd(a.low, b.low), _mm_sub_pd(a.high, b.high)};
}
inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return {_mm_mul_pd(a.low, b.low), _mm_mul_pd(a.high, b.high)};
}
inline Lanes operator|(const Lanes& a, const Lanes& b) {
  return {_mm_or_pd(a.low, b.low), _mm_or_pd(a.high, b.high)};
}
inline Lanes above(const Lanes& a, const Lanes& b) {
  return {_mm_cmpgt_pd(a.low, b.low), _mm_cmpgt_pd(a.high, b.high)};
}
inline uint32_t bits_of(const Lanes& a) {
  return static_cast<uint32_t>(_mm_movemask_pd(a.low) | _mm_movemask_pd(a.high) << 2);
}

}  // namespace
}  // namespace kaamos::embree

#include "runtime/embree/exact_pack_filter.h"

namespace kaamos::embree {

uint32_t filter_pack_sse2(const ExactRay& ray, const TrianglePack& pack) {
  return filter_pack(ray, pack);
}

}  // namespace kaamos::embree
