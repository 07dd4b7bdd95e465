// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. The bytes that indirect operations need: upper bounds from the inputs alone, which
// grow with every count. [DXR 2.0: D3D12_RTAS_OPERATION_PREBUILD_INFO]
#pragma once

#include <algorithm>
#include <cstdint>
#include <variant>

#include <rtapi/rtas_operations.h>

#include "runtime/backend/commands.h"

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

// The size of one kind of object: `fixed` bytes, some for each of its elements, and the alignment.
struct ObjectSize {
  uint64_t alignment;
  uint64_t fixed;
  uint64_t first_each;
  uint64_t second_each;

  constexpr uint64_t of(uint64_t first, uint64_t second = 0) const {
    return round_up_to(fixed + first * first_each + second * second_each, alignment);
  }
  // Of `count` objects, however the elements are spread over them. Without rounding, so that two
  // batches never need more than one of both.
  constexpr uint64_t of_all(uint64_t count, uint64_t first, uint64_t second = 0) const {
    return count * (fixed + alignment) + first * first_each + second * second_each;
  }
};

// By triangle: indices, geometry index and flags, a micromap index. By vertex: a position.
inline constexpr ObjectSize kClusterSize = {rtapi::kRtasClasByteAlignment, 128, 16, 12};
inline constexpr ObjectSize kTemplateSize = {rtapi::kRtasClusterTemplateByteAlignment, 128, 16, 0};
// By cluster: its address.
inline constexpr ObjectSize kClusteredLevelSize = {
    rtapi::kRaytracingAccelerationStructureByteAlignment, 256, 16, 0};

// What all batched operations have in common.
struct BatchFacts {
  rtapi::RtasOperationMode mode = {};
  uint32_t max_args = 0;
  uint64_t arg_bytes = 0;
  uint64_t alignment = 0;   // of results
  uint64_t most_bytes = 0;  // of one result
  uint64_t all_bytes = 0;   // of all together
};

constexpr BatchFacts facts_of(const rtapi::RtasClusterLimits& limits, rtapi::RtasOperationMode mode,
                              const ObjectSize& size, uint64_t arg_bytes) {
  const uint64_t args = limits.MaxArgCount;
  const uint64_t triangles =
      std::min<uint64_t>(limits.MaxTotalTriangleCount, args * limits.MaxTriangleCountPerCluster);
  const uint64_t vertices =
      std::min<uint64_t>(limits.MaxTotalVertexCount, args * limits.MaxVertexCountPerCluster);
  return {mode,
          limits.MaxArgCount,
          arg_bytes,
          size.alignment,
          size.of(limits.MaxTriangleCountPerCluster, limits.MaxVertexCountPerCluster),
          size.of_all(args, triangles, vertices)};
}
constexpr BatchFacts facts_of(const rtapi::RtasClusterTrianglesInputsDesc& inputs) {
  return facts_of(inputs.Limits, inputs.Mode, kClusterSize,
                  sizeof(rtapi::RtasBuildClasFromTrianglesArgs));
}
constexpr BatchFacts facts_of(const rtapi::RtasClusterTemplateTrianglesInputsDesc& inputs) {
  return facts_of(inputs.Limits, inputs.Mode, kTemplateSize,
                  sizeof(rtapi::RtasBuildClusterTemplatesFromTrianglesArgs));
}
constexpr BatchFacts facts_of(const rtapi::RtasInstantiateClusterTemplateInputsDesc& inputs) {
  return facts_of(inputs.Limits, inputs.Mode, kClusterSize,
                  sizeof(rtapi::RtasInstantiateClusterTemplatesArgs));
}
constexpr BatchFacts facts_of(const rtapi::RtasClasInputsDesc& inputs) {
  const uint64_t clusters = std::min<uint64_t>(
      inputs.MaxTotalClasCount, uint64_t{inputs.MaxArgCount} * inputs.MaxClasCountPerArg);
  return {inputs.Mode,
          inputs.MaxArgCount,
          sizeof(rtapi::RtasBuildBlasFromClasArgs),
          kClusteredLevelSize.alignment,
          kClusteredLevelSize.of(inputs.MaxClasCountPerArg),
          kClusteredLevelSize.of_all(inputs.MaxArgCount, clusters)};
}
constexpr BatchFacts facts_of(const rtapi::RtasClusterMovesDesc& inputs) {
  using Type = rtapi::RtasMoveOperationType;
  const ObjectSize& size = inputs.Type == Type::kClusterLevelAccelerationStructure ? kClusterSize
                           : inputs.Type == Type::kClusterTemplate                 ? kTemplateSize
                                                                   : kClusteredLevelSize;
  return {inputs.Mode,    inputs.MaxArgCount,   sizeof(rtapi::RtasMoveClusterObjectsArgs),
          size.alignment, inputs.MaxBytesMoved, inputs.MaxBytesMoved};
}

// Of any inputs but those of partitioned top levels.
inline BatchFacts facts_of(const RtasInputs& inputs) {
  return std::visit(
      [](const auto& desc) -> BatchFacts {
        if constexpr (requires { desc.InstanceCount; }) {
          return {};
        } else {
          return facts_of(desc);
        }
      },
      inputs);
}

inline rtapi::RtasOperationPrebuildInfo operation_sizes(const RtasInputs& inputs) {
  if (const auto* desc = std::get_if<rtapi::RtasPartitionedTlasInputsDesc>(&inputs)) {
    return {partitioned_bytes(*desc), kOperationScratchBytes};
  }
  const BatchFacts facts = facts_of(inputs);
  const bool moves = std::holds_alternative<rtapi::RtasClusterMovesDesc>(inputs);
  if (moves || facts.mode == rtapi::RtasOperationMode::kGetSizes) {
    return {0, kOperationScratchBytes};
  }
  const bool whole = facts.mode == rtapi::RtasOperationMode::kImplicitDestinations;
  return {whole ? facts.all_bytes : facts.most_bytes, kOperationScratchBytes};
}

}  // namespace kaamos::runtime
