// SPDX-License-Identifier: MIT
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::embree {

// Services::trace_ray. Returns when all shaders of the ray are done.
void trace_ray(shader::Invocation& caller, const shader::TraceRayArguments& arguments,
               void* payload, shader::RayLanes origin_t_min, shader::RayLanes direction_t_max);

// Services::call_shader.
void call_shader(shader::Invocation& caller, uint32_t shader_index, void* data,
                 uint32_t data_bytes);

}  // namespace kaamos::embree
