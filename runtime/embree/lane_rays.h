// SPDX-License-Identifier: MIT
//
// Prepares the rays of several lanes at once for TraceRay, before it traces them one after another:
// which are valid, their intervals, and the boxes that they enter.
#pragma once

#include "kaamos/shader/abi.h"
#include "kaamos/shader/cpu_level.h"
#include "runtime/embree/instance_boxes.h"

namespace kaamos::embree {

struct LaneSearches {
  BoxEntries<shader::kLanes> entries_of(int lane) const { return {entry[0] + lane}; }

  uint32_t valid;  // is_valid() of ray_setup.h, one bit each; the rest needs it
  // next_above() of t_min, at least 0, and next_below() of t_max [ray_state.h].
  float t_near[shader::kLanes];
  float t_far[shader::kLanes];
  // As from InstanceBoxes::enter, for the closed interval from t_min, at least 0, to t_max.
  EnteredBoxes entered[shader::kLanes];
  alignas(32) float entry[kMostInstanceBoxes][shader::kLanes];
};

void search_lanes(const shader::LaneRays& rays, const InstanceBoxes& boxes, LaneSearches& out,
                  shader::CpuLevel level = shader::cpu_level());

}  // namespace kaamos::embree
