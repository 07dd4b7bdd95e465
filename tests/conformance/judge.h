// SPDX-License-Identifier: MIT
//
// Compares what rays met with the reference.
#pragma once

#include <string>
#include <vector>

#include "tests/conformance/walker.h"

namespace kaamos::conformance {

// Counts what a random test covered, so that it cannot pass without having tested anything.
struct Coverage {
  uint32_t rays = 0;
  uint32_t certain = 0;  // rays whose result cannot depend on rounding
  uint32_t hits = 0;
  uint32_t events = 0;
  uint32_t required_events = 0;
};

// Returns how one ray differs from the reference; empty if it does not.
std::string judge_ray(const Scene& scene, const Ray& ray, const Walked& walked, Coverage& coverage);

// Compares each ray with the reference: which any-hit shaders ran, in which order, and what ended
// the ray. Fails the rule with the first few rays that differ.
Coverage judge(Context& t, const Scene& scene, const std::vector<Ray>& rays,
               const std::vector<Walked>& walked);

}  // namespace kaamos::conformance
