// SPDX-License-Identifier: MIT
//
// Decides which candidates a ray sees, and says why it does not see the others.
// [DXR: TraceRay control flow]
#pragma once

#include <optional>
#include <string>

#include <rtapi/explain.h>

#include "runtime/explain/scene.h"

namespace kaamos::explain {

// The state of one ray at one moment, which decides about its candidates.
struct Search {
  uint32_t flags = 0;  // including the pipeline's, and shader::kRayQueryAllowsMicromaps
  uint32_t inclusion_mask = 0;
  float t_min = 0;
  float t_max = 0;
  float committed_t = 0;  // t_max if there is no committed hit
  bool committed = false;
  bool ended = false;
};

enum class OpacitySource { kGeometry, kMicromap, kInstance, kRay };
struct Opacity {
  bool opaque = false;
  bool transparent = false;  // by a micromap: nothing brings it back
  OpacitySource source = OpacitySource::kGeometry;
};
// The ray's flags override the instance's, and those the micromap's or else the geometry's.
Opacity opacity_of(const Candidate& candidate, const Instance& instance, uint32_t ray_flags);
bool is_front_face(const Candidate& candidate, const Instance& instance);

// Empty if the candidate is offered.
std::optional<rtapi::CandidateOutcome> refusal(const Search& search, const Candidate& candidate,
                                               const Instance& instance);
// The refusal in words.
std::string refusal_text(rtapi::CandidateOutcome outcome, const Search& search,
                         const Candidate& candidate, const Instance& instance);
// "opaque by the geometry's flag"
std::string opacity_text(const Opacity& opacity);

}  // namespace kaamos::explain
