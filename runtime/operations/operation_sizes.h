// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. The bytes that indirect operations need: upper bounds from the inputs alone, which
// grow with every count. [DXR 2.0: D3D12_RTAS_OPERATION_PREBUILD_INFO]
#pragma once

#include <cstdint>

#include <rtapi/rtas_operations.h>

namespace kaamos::runtime {

inline constexpr uint64_t kOperationScratchBytes = 256;

constexpr uint64_t round_up_to(uint64_t bytes, uint64_t alignment) {
  return (bytes + alignment - 1) / alignment * alignment;
}

// A header, as many bytes for an instance as in a top level, its arguments, and a translation for
// each partition.
constexpr uint64_t partitioned_bytes(const rtapi::RtasPartitionedTlasInputsDesc& inputs) {
  constexpr uint64_t kInstanceBytes = 320 + sizeof(rtapi::RtasPartitionedTlasWriteInstanceArgs);
  constexpr uint64_t kPartitionBytes = 16;
  return round_up_to(256 + inputs.InstanceCount * kInstanceBytes +
                         (uint64_t{inputs.PartitionCount} + 1) * kPartitionBytes,
                     rtapi::kRaytracingAccelerationStructureByteAlignment);
}

constexpr rtapi::RtasOperationPrebuildInfo operation_sizes(
    const rtapi::RtasPartitionedTlasInputsDesc& inputs) {
  return {partitioned_bytes(inputs), kOperationScratchBytes};
}

}  // namespace kaamos::runtime
