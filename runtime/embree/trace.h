// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "kaamos/shader/abi.h"

namespace kaamos::embree {

struct Worker;

// Services::trace_ray. Returns when all shaders of the ray have run.
void trace_ray(shader::Invocation& caller, const shader::TraceRayArguments& arguments,
               void* payload, shader::RayLanes origin_t_min, shader::RayLanes direction_t_max);

// Services::trace_hit_object: the same without closest-hit and miss shaders.
void trace_hit_object(shader::Invocation& caller, const shader::TraceRayArguments& arguments,
                      void* payload, shader::RayLanes origin_t_min,
                      shader::RayLanes direction_t_max, shader::HitObject& hit);

// Removes the device if the caller may trace no more. [DXR: Ray recursion limit]
void check_depth(Worker& worker, const shader::Invocation& caller);

// Services::trace_rays.
void trace_rays(shader::Invocation& caller, const shader::TraceRayArguments& arguments,
                void* payloads, const shader::LaneRays& rays, uint32_t lanes);

// Calls trace(lane, payload, origin and TMin, direction and TMax) for one lane after another, with
// the lane's index in `caller`.
template <typename Trace>
void trace_each(shader::Invocation& caller, const shader::TraceRayArguments& arguments,
                void* payloads, const shader::LaneRays& rays, uint32_t lanes, Trace trace) {
  const uint32_t first_x = caller.index[0];
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    caller.index[0] = first_x + static_cast<uint32_t>(lane);
    trace(lane,
          static_cast<uint8_t*>(payloads) + static_cast<size_t>(lane) * arguments.payload_bytes,
          origin_t_min(rays, lane), direction_t_max(rays, lane));
  }
}

// Services::call_shader.
void call_shader(shader::Invocation& caller, uint32_t shader_index, void* data,
                 uint32_t data_bytes);

}  // namespace kaamos::embree
