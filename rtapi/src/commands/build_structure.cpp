// SPDX-License-Identifier: MIT
#include <rtapi/build_structure.h>
#include <rtapi/upload.h>

#include <algorithm>

#include "rtapi/src/device/device_impl.h"

namespace rtapi {

using namespace detail;

Result<Buffer> BuildAccelerationStructure(const Device& device, const CommandQueue& queue,
                                          const BuildRaytracingAccelerationStructureInputs& inputs,
                                          std::string name, const Buffer& source) {
  using Flags = RaytracingAccelerationStructureBuildFlags;
  if (!queue)
    return make_error(Id::kNullHandle, "BuildAccelerationStructure: an empty queue handle");
  const auto sizes = device.GetRaytracingAccelerationStructurePrebuildInfo(inputs);
  if (!sizes.ok()) return sizes.error();
  // An update that the list will refuse needs none.
  const uint64_t bytes = HasAny(inputs.Flags, Flags::kPerformUpdate)
                             ? sizes->UpdateScratchDataSizeInBytes
                             : sizes->ScratchDataSizeInBytes;
  auto scratch = device.CreateBuffer({.SizeInBytes = std::max<uint64_t>(bytes, 256),
                                      .Flags = ResourceFlags::kAllowUnorderedAccess,
                                      .Name = name + " scratch"});
  if (!scratch.ok()) return scratch.error();
  auto structure =
      device.CreateBuffer({.SizeInBytes = sizes->ResultDataMaxSizeInBytes,
                           .Flags = ResourceFlags::kAllowUnorderedAccess,
                           .InitialState = ResourceStates::kRaytracingAccelerationStructure,
                           .Name = std::move(name)});
  if (!structure.ok()) return structure.error();
  auto list = device.CreateCommandList();
  if (!list.ok()) return list.error();
  list->BuildRaytracingAccelerationStructure(
      {.DestAccelerationStructureData = structure->GetGPUVirtualAddress(),
       .Inputs = inputs,
       .SourceAccelerationStructureData = source ? source.GetGPUVirtualAddress() : 0,
       .ScratchAccelerationStructureData = scratch->GetGPUVirtualAddress()});
  if (Status s = queue.ExecuteAndWait(*list); !s.ok()) return s.error();
  return structure;
}

Result<Buffer> BuildBottomLevel(const Device& device, const CommandQueue& queue,
                                std::span<const RaytracingGeometryDesc> geometries,
                                std::string name, RaytracingAccelerationStructureBuildFlags flags) {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.Flags = flags;
  inputs.NumDescs = static_cast<uint32_t>(geometries.size());
  inputs.pGeometryDescs = geometries.data();
  return BuildAccelerationStructure(device, queue, inputs, std::move(name));
}

Result<Buffer> BuildTopLevel(const Device& device, const CommandQueue& queue,
                             std::span<const RaytracingInstanceDesc> instances, std::string name,
                             RaytracingAccelerationStructureBuildFlags flags) {
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Flags = flags;
  inputs.NumDescs = static_cast<uint32_t>(instances.size());
  if (instances.empty()) return BuildAccelerationStructure(device, queue, inputs, std::move(name));
  const auto descs = CreateUploadBuffer(device, std::as_bytes(instances), name + " instances");
  if (!descs.ok()) return descs.error();
  inputs.InstanceDescs = descs->GetGPUVirtualAddress();
  return BuildAccelerationStructure(device, queue, inputs, std::move(name));
}

}  // namespace rtapi
