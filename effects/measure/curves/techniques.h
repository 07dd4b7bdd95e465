// SPDX-License-Identifier: MIT
// What --measure and --study ask of a technique: its settings from fast to accurate, held against
// rays that reach equally far.
#pragma once

#include "effects/measure/curves/measure.h"

namespace kaamos::measure {

// Adds all settings of an effect as one group, held against the plan's first reference: its steps,
// else counts of samples, or its defaults where the count is fixed. Its radius is that of the
// options; contact shadows get the length of the reference.
void add_technique(const effects::Effect& row, const Options& options, MeasurePlan& plan);

// Keeps the first, the middle and the last setting of each group.
void keep_three_of_each(MeasurePlan& plan);

// Returns the name of the reference of rays of this radius, which the plan gets where it has none.
std::string radius_reference(float radius, MeasurePlan& plan);

// "0.5 m".
std::string radius_label(float radius);

}  // namespace kaamos::measure
