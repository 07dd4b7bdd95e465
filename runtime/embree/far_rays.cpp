// SPDX-License-Identifier: MIT
#include "runtime/embree/far_rays.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "runtime/embree/ray_state.h"
#include "runtime/errors/text.h"

namespace kaamos::embree {
namespace {

bool is_less(const FarRays& a, const FarRays& b) {
  if (a.instance != b.instance) return a.instance < b.instance;
  return std::lexicographical_compare(a.ray, a.ray + 6, b.ray, b.ray + 6);
}

std::string text_of(const float values[3]) {
  return errors::concat("(", values[0], ", ", values[1], ", ", values[2], ")");
}

void note(Worker& worker, __m128 origin, __m128 direction, uint32_t instance) {
  FarRays one;
  one.count = 1;
  one.instance = instance;
  alignas(16) float lanes[4];
  _mm_store_ps(lanes, origin);
  std::copy(lanes, lanes + 3, one.ray);
  _mm_store_ps(lanes, direction);
  std::copy(lanes, lanes + 3, one.ray + 3);
  const bool is_finite =
      std::all_of(one.ray, one.ray + 6, [](float value) { return std::isfinite(value); });
  if (is_finite) worker.far_rays.add(one);
}

}  // namespace

void FarRays::add(const FarRays& other) {
  if (other.count == 0) return;
  const uint64_t sum = count + other.count;
  if (count == 0 || is_less(other, *this)) *this = other;
  count = sum;
}

std::string FarRays::message(const char* label) const {
  const std::string where =
      instance == kWorld ? "" : " in the space of instance " + std::to_string(instance);
  return "the ray from " + text_of(ray) + " along " + text_of(ray + 3) +
         " has a coordinate past 1.8e18" + where + " and misses what may lie there; " +
         std::to_string(count) + (count == 1 ? " ray does" : " rays do") + " (" + label + ")";
}

void note_far_ray(Worker& worker, const ObjectRay& world, float t_min, float t_max) {
  if (!(t_min <= t_max && t_min <= FLT_MAX)) return;
  note(worker, world.origin, world.direction, FarRays::kWorld);
}

void note_far_ray(const RayState& state, uint32_t instance) {
  note(*state.worker, _mm_load_ps(state.values.ray.origin), _mm_load_ps(state.values.ray.direction),
       instance);
}

}  // namespace kaamos::embree
