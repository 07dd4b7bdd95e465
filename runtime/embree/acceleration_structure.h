// SPDX-License-Identifier: MIT
//
// The commands that make, copy and describe acceleration structures.
#pragma once

#include <span>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/commands.h"
#include "runtime/embree/bottom_level.h"

namespace kaamos::embree {

class Device;

// Upper estimates from counts and flags alone, growing with every count. Embree keeps its memory
// itself: pages of the result buffer beyond the first are never touched, and cost nothing.
rtapi::RaytracingAccelerationStructurePrebuildInfo estimate_sizes(
    rtapi::RaytracingAccelerationStructureType type, BuildFlags flags,
    std::span<const rtapi::RaytracingGeometryDesc> geometries, uint32_t instance_count);

// Errors remove the device; whatever does no harm is a message.
rtapi::Status build(Device& device, const runtime::BuildCommand& command);
rtapi::Status copy(Device& device, const runtime::CopyAccelerationStructureCommand& command);
rtapi::Status emit_postbuild_info(
    Device& device, const rtapi::RaytracingAccelerationStructurePostbuildInfoDesc& desc,
    std::span<const uint64_t> sources);

}  // namespace kaamos::embree
