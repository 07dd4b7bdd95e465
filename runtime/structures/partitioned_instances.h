// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. What the instances and partitions of a partitioned top level were last set to, and
// what rays meet of them. [DXR 2.0: Partitioned TLAS]
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <rtapi/result.h>
#include <rtapi/rtas_operations.h>

#include "runtime/structures/instances.h"
#include "runtime/structures/structure_copies.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

using Translation = std::array<float, 3>;

// An instance as the last WRITE_INSTANCE and the UPDATE_INSTANCEs since then left it.
struct PartitionedInstance {
  rtapi::RtasPartitionedTlasWriteInstanceArgs args = {};
  bool written = false;  // never written: inactive, and in no partition
};

struct PartitionedTopLevel {
  rtapi::RtasPartitionedTlasInputsDesc inputs;
  std::vector<PartitionedInstance> slots;  // by InstanceIndex
  // With kEnablePartitionTranslation, by PartitionIndex; otherwise empty, and all are zero.
  std::vector<Translation> translations;
  Translation global_translation = {};
  // Non-degenerate instances by partition, at the end those of the global one; empty: not counted.
  std::vector<uint32_t> members;
  // What rays meet, by InstanceIndex: with translations, and inactive where nothing can be hit.
  std::vector<Instance> instances;

  bool translates() const {
    return rtapi::HasAny(inputs.Flags,
                         rtapi::RtasPartitionedTlasFlags::kEnablePartitionTranslation);
  }
  // Among the partitions; the global one is the last.
  uint32_t place_of(uint32_t partition) const {
    return partition == rtapi::kRtasPartitionIndexGlobalPartition ? inputs.PartitionCount
                                                                  : partition;
  }
  const Translation& translation_of(uint32_t partition) const;
};

// Calls `visit` with the record and the InstanceID of each instance of a top level, partitioned or
// not, in the order of InstanceIndex.
template <class Visit>
void for_each_instance(const AccelerationStructure& top_level, Visit&& visit) {
  if (top_level.partitioned != nullptr) {
    for (const Instance& one : top_level.partitioned->instances) visit(one.desc, one.id);
  } else {
    for (const auto& desc : *top_level.instances) visit(desc, desc.InstanceID);
  }
}

// All rows without a 3x3 part, or NaN anywhere: not part of the top level at all, whatever its
// bottom level. [DXR 2.0: Degenerate PTLAS instances]
bool is_degenerate(const float (&transform)[3][4]);

// Sets what rays meet of an instance. Returns why that is nothing, if it was not clearly intended;
// otherwise null.
const char* activate(const StructureMap& structures, PartitionedTopLevel& level, uint32_t index);

// Builds result.top_level, or changes the one that it is where instances `changed`.
rtapi::Status build_partitioned_level(const RebuildLevel& rebuild, const PartitionedTopLevel& level,
                                      std::span<const uint32_t> changed,
                                      AccelerationStructure& result);

}  // namespace kaamos::runtime
