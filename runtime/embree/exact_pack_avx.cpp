// SPDX-License-Identifier: MIT
#include <immintrin.h>

#include "runtime/embree/exact_pack.h"

namespace kaamos::embree {
namespace {

struct Lanes {
  __m256d v;

  static Lanes load(const float* values) { return {_mm256_cvtps_pd(_mm_load_ps(values))}; }
  static Lanes all(double value) { return {_mm256_set1_pd(value)}; }
};

inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return {_mm256_sub_pd(a.v, b.v)};
}
inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return {_mm256_mul_pd(a.v, b.v)};
}
inline Lanes operator|(const Lanes& a, const Lanes& b) {
  return {_mm256_or_pd(a.v, b.v)};
}
inline Lanes above(const Lanes& a, const Lanes& b) {
  return {_mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ)};
}
inline uint32_t bits_of(const Lanes& a) {
  return static_cast<uint32_t>(_mm256_movemask_pd(a.v));
}

}  // namespace
}  // namespace kaamos::embree

#include "runtime/embree/exact_pack_filter.h"

namespace kaamos::embree {

uint32_t filter_pack_avx(const ExactRay& ray, const TrianglePack& pack) {
  return filter_pack(ray, pack);
}

}  // namespace kaamos::embree
