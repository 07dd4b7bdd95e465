// SPDX-License-Identifier: MIT
// Acceleration structures and DispatchRays.
#include <bit>

#include "d3d12/objects/device.h"
#include "d3d12/objects/graphics_command_list.h"
#include "d3d12/objects/same_bytes.h"

namespace kaamos::d3d12 {

void GraphicsCommandList::BuildRaytracingAccelerationStructure(
    const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC* desc, UINT postbuild_count,
    const D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC* postbuild) {
  if (desc == nullptr) {
    refuse(ErrorId::kNullPointer, "BuildRaytracingAccelerationStructure: pDesc.");
    return;
  }
  using PostbuildInfo = rtapi::RaytracingAccelerationStructurePostbuildInfoDesc;
  list_.BuildRaytracingAccelerationStructure(
      *same_bytes<rtapi::BuildRaytracingAccelerationStructureDesc>(desc),
      same_bytes<PostbuildInfo>(postbuild, postbuild_count));
}

void GraphicsCommandList::EmitRaytracingAccelerationStructurePostbuildInfo(
    const D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC* desc, UINT count,
    const D3D12_GPU_VIRTUAL_ADDRESS* sources) {
  if (desc == nullptr || (sources == nullptr && count != 0)) {
    refuse(ErrorId::kNullPointer,
           "EmitRaytracingAccelerationStructurePostbuildInfo: pDesc or the sources.");
    return;
  }
  list_.EmitRaytracingAccelerationStructurePostbuildInfo(
      *same_bytes<rtapi::RaytracingAccelerationStructurePostbuildInfoDesc>(desc),
      std::span<const rtapi::GpuVirtualAddress>(sources, count));
}

void GraphicsCommandList::CopyRaytracingAccelerationStructure(
    D3D12_GPU_VIRTUAL_ADDRESS dest, D3D12_GPU_VIRTUAL_ADDRESS source,
    D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE mode) {
  list_.CopyRaytracingAccelerationStructure(
      dest, source, static_cast<rtapi::RaytracingAccelerationStructureCopyMode>(mode));
}

void GraphicsCommandList::DispatchRays(const D3D12_DISPATCH_RAYS_DESC* desc) {
  if (desc == nullptr) {
    refuse(ErrorId::kNullPointer, "DispatchRays: pDesc.");
    return;
  }
  list_.DispatchRays(*same_bytes<rtapi::DispatchRaysDesc>(desc));
}

void Device::GetRaytracingAccelerationStructurePrebuildInfo(
    const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS* desc,
    D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO* info) {
  if (desc == nullptr || info == nullptr) {
    fail(ErrorId::kNullPointer, "GetRaytracingAccelerationStructurePrebuildInfo: pDesc or pInfo.");
    return;
  }
  *info = {};
  const auto result = device_.GetRaytracingAccelerationStructurePrebuildInfo(
      *same_bytes<rtapi::BuildRaytracingAccelerationStructureInputs>(desc));
  if (!result) {
    fail(result.error());
    return;
  }
  *info = {result->ResultDataMaxSizeInBytes, result->ScratchDataSizeInBytes,
           result->UpdateScratchDataSizeInBytes};
}

D3D12_DRIVER_MATCHING_IDENTIFIER_STATUS Device::CheckDriverMatchingIdentifier(
    D3D12_SERIALIZED_DATA_TYPE type,
    const D3D12_SERIALIZED_DATA_DRIVER_MATCHING_IDENTIFIER* identifier) {
  if (identifier == nullptr) return D3D12_DRIVER_MATCHING_IDENTIFIER_UNRECOGNIZED;
  return static_cast<D3D12_DRIVER_MATCHING_IDENTIFIER_STATUS>(device_.CheckDriverMatchingIdentifier(
      static_cast<rtapi::SerializedDataType>(type),
      *same_bytes<rtapi::SerializedDataDriverMatchingIdentifier>(identifier)));
}

}  // namespace kaamos::d3d12
