// SPDX-License-Identifier: MIT
//
// Holds what rays met against the reference.
#pragma once

#include <string>
#include <vector>

#include "tests/conformance/walker.h"

namespace kaamos::conformance {

// What a random test covered, so that it cannot pass on nothing.
struct Coverage {
  uint32_t rays = 0;
  uint32_t certain = 0;  // rays that rounding cannot turn
  uint32_t hits = 0;
  uint32_t events = 0;
  uint32_t required_events = 0;
};

// What differs from the reference for one ray, or nothing.
std::string judge_ray(const Scene& scene, const Ray& ray, const Walked& walked, Coverage& coverage);

// Compares each ray with the reference: the any-hit shaders that ran, in the order in which they
// did, and what ended it. Fails the rule with the first few rays that differ.
Coverage judge(Context& t, const Scene& scene, const std::vector<Ray>& rays,
               const std::vector<Walked>& walked);

}  // namespace kaamos::conformance
