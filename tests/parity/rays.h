// SPDX-License-Identifier: MIT
//
// The rays that both backends get, identical to the bit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "tests/parity/probe.h"

namespace kaamos::parity {

struct RaySet {
  std::string scene;  // "lounge", "mixed", or a glTF file
  // primary: through the pixels; flags: the same with random ray flags and masks; sun, ao:
  // visibility from the points that those hit; diffuse: from the same points, the next hit.
  std::string kind;
  uint32_t width = 480;
  uint32_t height = 270;
  uint32_t seed = 1;
  std::vector<ProbeRay> given;  // for kind "given"; a whole number of rows of `width`
};

// Empty if the set names no known scene or kind.
std::optional<effects::Scene> load_scene(const std::string& name);

struct RayRun {
  std::vector<ProbeRay> rays;
  uint32_t picture_width = 0;  // 0: the rays do not form a picture
  std::vector<HitRecord> hits[2];
};

// Traces the set on both backends. Secondary rays start at the first backend's hits. Throws
// rtapi::ResultError, or std::invalid_argument for an unknown set.
RayRun trace_on_both(const RaySet& set, const std::string (&backends)[2]);

// The command that traces one ray of the set again.
std::string retrace_command(const RaySet& set, uint64_t ray);

}  // namespace kaamos::parity
