// SPDX-License-Identifier: MIT
#include "own_top_level.h"

#include <limits>

#include "rtapi/src/device/device_impl.h"
#include "runtime/embree/device.h"
#include "runtime/embree/memory.h"
#include "runtime/embree/ray_state.h"
#include "tiles.h"

namespace kaamos::bench {
namespace {

using embree::RayState;
namespace shim = embree::shim;

constexpr uint8_t kEveryClass[3] = {embree::kAllClasses, embree::kAllClasses, embree::kAllClasses};

// The state that does not change from ray to ray.
RayState make_state(const embree::TopLevel& top_level) {
  RayState state = {};
  shim::init(state.query);
  state.top_level = &top_level;
  state.inclusion_mask = 0xFF;
  state.classes = kEveryClass;
  state.committed_t = std::numeric_limits<float>::infinity();
  return state;
}

void begin_ray(const Ray& in, RayState& state, RTCRay& ray) {
  state.t_near = embree::next_above(in.t_min);
  state.t_far = embree::next_below(in.t_max);
  _mm_store_ps(&ray.org_x, _mm_setr_ps(in.origin[0], in.origin[1], in.origin[2], state.t_near));
  _mm_store_ps(&ray.dir_x, _mm_setr_ps(in.direction[0], in.direction[1], in.direction[2], 0));
  ray.tfar = state.t_far;
  ray.mask = embree::kAllClasses;
  ray.id = 0;
  ray.flags = 0;
}

}  // namespace

OwnTopLevel::OwnTopLevel(const DxrScene& scene) {
  auto& device = static_cast<embree::Device&>(*scene.device().impl()->backend);
  top_level_ = device.memory().find_top_level(scene.top_level().GetGPUVirtualAddress());
}

void OwnTopLevel::closest(tbb::task_arena& arena, const RayGrid& grid,
                          std::vector<ClosestResult>& results) const {
  for_each_cell(arena, grid.width, grid.height, [&] {
    return [this, &grid, &results, state = make_state(*top_level_)](uint32_t index) mutable {
      RTCRayHit hit;
      begin_ray(grid.rays[index], state, hit.ray);
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      embree::intersect(state, hit);
      const bool missed = hit.hit.geomID == RTC_INVALID_GEOMETRY_ID;
      results[index] = {missed ? -1.0f : hit.ray.tfar, missed ? ~0u : hit.hit.primID};
    };
  });
}

void OwnTopLevel::visible(tbb::task_arena& arena, const RayGrid& grid,
                          std::vector<uint32_t>& results) const {
  for_each_cell(arena, grid.width, grid.height, [&] {
    return [this, &grid, &results, state = make_state(*top_level_)](uint32_t index) mutable {
      RTCRay ray;
      begin_ray(grid.rays[index], state, ray);
      embree::occlude(state, ray);
      results[index] = ray.tfar >= 0 ? 1 : 0;
    };
  });
}

}  // namespace kaamos::bench
