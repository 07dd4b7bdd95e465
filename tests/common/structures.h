// SPDX-License-Identifier: MIT
//
// Acceleration structures for tests: built at once, and ready when the call returns.
#pragma once

#include <rtapi/rtapi.h>

#include <string>
#include <vector>

namespace kaamos::test {

// These throw rtapi::ResultError.
inline rtapi::Buffer build_structure(
    const rtapi::Device& device, const rtapi::CommandQueue& queue,
    const rtapi::BuildRaytracingAccelerationStructureInputs& inputs,
    const std::string& name = "structure") {
  return rtapi::BuildAccelerationStructure(device, queue, inputs, name).value();
}

inline rtapi::Buffer build_bottom_level(
    const rtapi::Device& device, const rtapi::CommandQueue& queue,
    const std::vector<rtapi::RaytracingGeometryDesc>& geometries,
    const std::string& name = "bottom level") {
  return rtapi::BuildBottomLevel(device, queue, geometries, name,
                                 rtapi::RaytracingAccelerationStructureBuildFlags::kNone)
      .value();
}

inline rtapi::Buffer build_top_level(const rtapi::Device& device, const rtapi::CommandQueue& queue,
                                     const std::vector<rtapi::RaytracingInstanceDesc>& instances,
                                     const std::string& name = "top level") {
  return rtapi::BuildTopLevel(device, queue, instances, name,
                              rtapi::RaytracingAccelerationStructureBuildFlags::kNone)
      .value();
}

}  // namespace kaamos::test
