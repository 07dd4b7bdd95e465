// SPDX-License-Identifier: MIT
//
// DXR's rules for the arguments of dispatches, whether the host passes them or they are in GPU
// memory.
#pragma once

#include <cstdint>
#include <string>

#include <rtapi/raytracing.h>

#include "runtime/backend/address_map.h"

namespace kaamos::runtime {

// "byte 96 of buffer \"tables\" (416 bytes)", or that it is in no live buffer.
std::string describe_address(const AddressMap& addresses, uint64_t address);
// The same behind "at ".
std::string at_address(const AddressMap& addresses, uint64_t address);

enum class DispatchFault : uint8_t { kNone, kTableLayout, kTableMemory, kTooLarge };
struct DispatchProblem {
  DispatchFault fault = DispatchFault::kNone;
  std::string text;  // what is wrong, with the actual and the allowed value
};
// Checks the alignment of tables and strides, that tables are inside live buffers, and that there
// are at most 2^30 threads. [DXR: D3D12_DISPATCH_RAYS_DESC, DispatchRays]
DispatchProblem check_dispatch_rays(const AddressMap& addresses,
                                    const rtapi::DispatchRaysDesc& desc);
// At most 65535 groups in each dimension. [D3D12: Dispatch]
DispatchProblem check_dispatch(const uint32_t groups[3]);

}  // namespace kaamos::runtime
