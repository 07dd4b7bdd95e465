// SPDX-License-Identifier: MIT
// What the plans of sweeps are put together from.
#pragma once

#include <string>
#include <utility>

#include "effects/measure/study/plans.h"

namespace kaamos::measure {

// Rays of a pixel where noise is not what is asked about.
inline constexpr std::uint32_t kQuietRays = 16;

// The plan of a ray traced effect, whose first reference all is held against; without settings.
MeasurePlan base_plan(const std::string& effect, const Options& options);

// Adds a setting, held against the plan's first reference.
void add_to(MeasurePlan& plan, const std::string& group, std::string label, const Setting& setting);

// "1 ray", "4 rays".
std::string counted(std::uint32_t count, const char* thing);

template <class Constants, class Change>
Setting changed(Setting setting, Change change) {
  setting.change<Constants>(change);
  return setting;
}

}  // namespace kaamos::measure
