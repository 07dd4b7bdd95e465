// SPDX-License-Identifier: MIT
// Plans of sweeps over reflections and indirect light.
#pragma once

#include "effects/measure/study/plans.h"

namespace kaamos::measure {

StudyPlan ssr_sweep(const Options& options);  // stride and thickness of marches
StudyPlan roughness_sweep(
    const Options& options);  // of all materials, with a cap on lengths and without
StudyPlan voxel_sweep(const Options& options);   // cells of the volume
StudyPlan length_sweep(const Options& options);  // rays of indirect light

}  // namespace kaamos::measure
