// SPDX-License-Identifier: MIT
// One family of techniques on one backend, at rest or in motion: measured once, then kept.
#pragma once

#include <string>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "effects/measure/study/plans.h"
#include "effects/measure/study/result.h"

namespace kaamos::measure {

// Options::backend of --study: Embree, and Vulkan at a quarter of the width and height.
inline constexpr const char* kBothBackends = "both";

struct StudyPart {
  StudyFamily family;
  std::string backend;
  bool moves = false;       // along a camera path
  bool is_smaller = false;  // the second backend

  std::string name(const std::string& question = {}) const;  // of its files: "shadows-motion"
};

// At rest and, without options.quick, in motion, on each backend.
std::vector<StudyPart> study_parts(const StudyFamily& family, const Options& options);

// Adds what is found: one result, or one for each denoised signal. What an earlier run has found is
// taken from options.out/study.
rtapi::Result<Outcome> study_part(const StudyPart& part, const Options& options,
                                  const effects::Scene& scene, const Progress& progress,
                                  std::vector<StudyResult>& results);

}  // namespace kaamos::measure
