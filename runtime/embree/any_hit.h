// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/embree/ray_state.h"

namespace kaamos::embree {

// A hit that an any-hit shader decides about.
struct Candidate {
  float t;
  uint32_t hit_kind;
  uint32_t geometry;  // its slot
  uint32_t primitive;
  const void* attributes;
};

// Runs the record's any-hit shader, which must exist, on the instance being traversed.
shader::AnyHitResult run_any_hit(RayState& state, const ShaderRecord& record,
                                 const Candidate& candidate);

}  // namespace kaamos::embree
