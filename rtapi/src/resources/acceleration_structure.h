// SPDX-License-Identifier: MIT
//
// The checks of builds and copies that need no look at GPU memory.
#pragma once

#include <string_view>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "rtapi/src/device/device_impl.h"
#include "runtime/backend/commands.h"

namespace rtapi::detail {

// Checks a description whose addresses must be there.
Status check_build_inputs(const DeviceImpl& device,
                          const BuildRaytracingAccelerationStructureInputs& inputs);
// Copies inputs that passed the checks, with all that they name in host memory.
runtime::BuildCommand describe_build(const BuildRaytracingAccelerationStructureInputs& inputs);
// Checks alignment, liveness and extent of every address.
Status check_build_addresses(const DeviceImpl& device,
                             const BuildRaytracingAccelerationStructureDesc& desc,
                             const runtime::BuildCommand& command);
Status check_postbuild_info(const DeviceImpl& device,
                            const RaytracingAccelerationStructurePostbuildInfoDesc& desc,
                            size_t count);
// Checks that the address is aligned and inside a buffer made for acceleration structures.
Status check_structure_address(const DeviceImpl& device, GpuVirtualAddress address,
                               std::string_view what, uint32_t alignment);
// Checks that the address is 256-aligned and that `bytes` from it are inside a plain buffer; if
// `written`, one that shaders may write.
Status check_structure_bytes(const DeviceImpl& device, GpuVirtualAddress address, uint64_t bytes,
                             bool written, std::string_view what);

}  // namespace rtapi::detail
