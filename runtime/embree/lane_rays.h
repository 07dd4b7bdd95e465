// SPDX-License-Identifier: MIT
//
// What TraceRay finds out of the rays of several lanes at once, before it traces one after the
// other: which of them are valid, their intervals, and the boxes that they enter.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/cpu_level.h"
#include "runtime/embree/instance_boxes.h"

namespace kaamos::embree {

struct LaneSearches {
  BoxEntries<shader::kLanes> entries_of(int lane) const { return {entry[0] + lane}; }

  uint32_t valid;  // a bit each: is_valid() of ray_setup.h; of others the rest is undefined
  // next_above() of t_min, at least 0, and next_below() of t_max [ray_state.h].
  float t_near[shader::kLanes];
  float t_far[shader::kLanes];
  // As InstanceBoxes::enter, of the closed interval from t_min, at least 0, to t_max.
  EnteredBoxes entered[shader::kLanes];
  alignas(32) float entry[kMostInstanceBoxes][shader::kLanes];
};

void search_lanes(const shader::LaneRays& rays, const InstanceBoxes& boxes, LaneSearches& out,
                  shader::CpuLevel level = shader::cpu_level());

}  // namespace kaamos::embree
