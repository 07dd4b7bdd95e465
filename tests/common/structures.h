// SPDX-License-Identifier: MIT
//
// Acceleration structures for tests: built at once, and ready when the call returns.
#pragma once

#include <rtapi/rtapi.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace kaamos::test {

// Builds, or updates `source` into a structure of its own where the inputs' flags ask for that.
inline rtapi::Result<rtapi::Buffer> try_build_structure(
    const rtapi::Device& device, rtapi::CommandQueue& queue,
    const rtapi::BuildRaytracingAccelerationStructureInputs& inputs,
    const std::string& name = "structure", const rtapi::Buffer* source = nullptr) {
  const auto sizes = device.GetRaytracingAccelerationStructurePrebuildInfo(inputs);
  if (!sizes) return sizes.error();
  rtapi::BufferDesc desc;
  desc.SizeInBytes = std::max<std::uint64_t>(
      {sizes->ScratchDataSizeInBytes, sizes->UpdateScratchDataSizeInBytes, 256});
  desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
  desc.Name = "scratch";
  const auto scratch = device.CreateBuffer(desc);
  if (!scratch) return scratch.error();
  desc.SizeInBytes = sizes->ResultDataMaxSizeInBytes;
  desc.InitialState = rtapi::ResourceStates::kRaytracingAccelerationStructure;
  desc.Name = name;
  auto structure = device.CreateBuffer(desc);
  if (!structure) return structure;
  auto list = device.CreateCommandList();
  if (!list) return list.error();
  list->BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = structure->GetGPUVirtualAddress(),
       .Inputs = inputs,
       .SourceAccelerationStructureData = source != nullptr ? source->GetGPUVirtualAddress() : 0,
       .ScratchAccelerationStructureData = scratch->GetGPUVirtualAddress()});
  if (const auto done = queue.ExecuteAndWait(*list); !done) return done.error();
  return structure;
}

// The next three throw rtapi::ResultError.
inline rtapi::Buffer build_structure(
    const rtapi::Device& device, rtapi::CommandQueue& queue,
    const rtapi::BuildRaytracingAccelerationStructureInputs& inputs,
    const std::string& name = "structure") {
  return try_build_structure(device, queue, inputs, name).value();
}

inline rtapi::Buffer build_bottom_level(
    const rtapi::Device& device, rtapi::CommandQueue& queue,
    const std::vector<rtapi::RaytracingGeometryDesc>& geometries,
    const std::string& name = "bottom level") {
  rtapi::BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = rtapi::RaytracingAccelerationStructureType::kBottomLevel;
  inputs.NumDescs = static_cast<std::uint32_t>(geometries.size());
  inputs.pGeometryDescs = geometries.data();
  return build_structure(device, queue, inputs, name);
}

// No instances make an empty top level.
inline rtapi::Buffer build_top_level(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                     const std::vector<rtapi::RaytracingInstanceDesc>& instances,
                                     const std::string& name = "top level") {
  rtapi::BuildRaytracingAccelerationStructureInputs inputs;
  inputs.NumDescs = static_cast<std::uint32_t>(instances.size());
  if (instances.empty()) return build_structure(device, queue, inputs, name);
  const rtapi::Buffer records = rtapi::CreateUploadBuffer(device, instances, "instances").value();
  inputs.InstanceDescs = records.GetGPUVirtualAddress();
  return build_structure(device, queue, inputs, name);
}

}  // namespace kaamos::test
