// SPDX-License-Identifier: MIT
/// @file
/// Acceleration structures in one call: each creates the memory, builds and waits. For start-up
/// code, tests and tools; a frame that builds records
/// CommandList::BuildRaytracingAccelerationStructure itself.
#pragma once

#include <initializer_list>
#include <span>
#include <string>

#include <rtapi/command_queue.h>
#include <rtapi/device.h>
#include <rtapi/raytracing.h>

namespace rtapi {

/// A new buffer, called `name`, with the structure that `inputs` describe. What the inputs name by
/// address is read before the call returns and may be freed then, bottom levels excepted. With
/// kPerformUpdate `source` is refitted into the new buffer and stays as it is.
/// @errors KA0904 an empty handle; those of Device::GetRaytracingAccelerationStructurePrebuildInfo,
/// Device::CreateBuffer, CommandList::BuildRaytracingAccelerationStructure and
/// CommandQueue::ExecuteAndWait.
Result<Buffer> BuildAccelerationStructure(const Device& device, const CommandQueue& queue,
                                          const BuildRaytracingAccelerationStructureInputs& inputs,
                                          std::string name = {}, const Buffer& source = {});

/// A bottom level of `geometries`; none make an empty one.
/// @errors as of BuildAccelerationStructure, KA0904 among them.
Result<Buffer> BuildBottomLevel(const Device& device, const CommandQueue& queue,
                                std::span<const RaytracingGeometryDesc> geometries,
                                std::string name = {},
                                RaytracingAccelerationStructureBuildFlags flags =
                                    RaytracingAccelerationStructureBuildFlags::kPreferFastTrace);
/// @overload
inline Result<Buffer> BuildBottomLevel(
    const Device& device, const CommandQueue& queue,
    std::initializer_list<RaytracingGeometryDesc> geometries, std::string name = {},
    RaytracingAccelerationStructureBuildFlags flags =
        RaytracingAccelerationStructureBuildFlags::kPreferFastTrace) {
  return BuildBottomLevel(
      device, queue, std::span<const RaytracingGeometryDesc>(geometries.begin(), geometries.size()),
      std::move(name), flags);
}

/// A top level of `instances`, which an upload buffer brings to the device; none make an empty one.
/// @errors as of BuildAccelerationStructure, KA0904 among them.
Result<Buffer> BuildTopLevel(const Device& device, const CommandQueue& queue,
                             std::span<const RaytracingInstanceDesc> instances,
                             std::string name = {},
                             RaytracingAccelerationStructureBuildFlags flags =
                                 RaytracingAccelerationStructureBuildFlags::kPreferFastTrace);
/// @overload
inline Result<Buffer> BuildTopLevel(
    const Device& device, const CommandQueue& queue,
    std::initializer_list<RaytracingInstanceDesc> instances, std::string name = {},
    RaytracingAccelerationStructureBuildFlags flags =
        RaytracingAccelerationStructureBuildFlags::kPreferFastTrace) {
  return BuildTopLevel(device, queue,
                       std::span<const RaytracingInstanceDesc>(instances.begin(), instances.size()),
                       std::move(name), flags);
}

}  // namespace rtapi
