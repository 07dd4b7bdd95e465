// SPDX-License-Identifier: MIT
#include "runtime/embree/far_rays.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "runtime/embree/ray_state.h"
#include "runtime/errors/text.h"

namespace kaamos::embree {
namespace {

bool are_finite(const float values[3]) {
  return std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2]);
}

std::string text_of(const float values[3]) {
  return errors::concat("(", values[0], ", ", values[1], ", ", values[2], ")");
}

void note(Worker& worker, const float origin[3], const float direction[3], uint32_t instance) {
  if (!are_finite(origin) || !are_finite(direction)) return;
  const std::lock_guard lock(worker.dispatch->mutex);
  FarRays& rays = worker.dispatch->far_rays;
  if (rays.count++ != 0) return;
  rays.instance = instance;
  std::copy(origin, origin + 3, rays.origin);
  std::copy(direction, direction + 3, rays.direction);
}

}  // namespace

std::string FarRays::message(const char* label) const {
  const std::string where =
      instance == kWorld ? "" : " in the space of instance " + std::to_string(instance);
  return std::to_string(count) + (count == 1 ? " ray" : " rays") + " missed what may lie there (" +
         label + "): the first, from " + text_of(origin) + " along " + text_of(direction) +
         ", has a coordinate past 1.8e18" + where;
}

void note_far_ray(Worker& worker, const ObjectRay& world, float t_min, float t_max) {
  if (!(t_min <= t_max && t_min <= FLT_MAX)) return;
  alignas(16) float origin[4];
  alignas(16) float direction[4];
  _mm_store_ps(origin, world.origin);
  _mm_store_ps(direction, world.direction);
  note(worker, origin, direction, FarRays::kWorld);
}

void note_far_ray(const RayState& state, uint32_t instance) {
  note(*state.worker, state.values.ray.origin, state.values.ray.direction, instance);
}

}  // namespace kaamos::embree
