// SPDX-License-Identifier: MIT
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::embree {

// What the shaders of this backend may call; one table for all dispatches.
const shader::Services& services();

// The listener is told of every TraceRay before the ray is traced, on the thread that traces it.
// For benchmarks that replay a dispatch's rays; null: no listener, at no cost. Takes effect with
// the next dispatch.
using RayListener = void (*)(const shader::TraceRayArguments& arguments,
                             shader::RayLanes origin_t_min, shader::RayLanes direction_t_max);
void set_ray_listener(RayListener listener);

}  // namespace kaamos::embree
