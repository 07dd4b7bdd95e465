// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Partitioned top levels: what the instances and partitions of one were last set to,
// and the operations that change them. [DXR 2.0: Partitioned TLAS]
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <rtapi/result.h>
#include <rtapi/rtas_operations.h>

#include "runtime/backend/commands.h"
#include "runtime/operations/notes.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/structure_commands.h"
#include "runtime/structures/structure_copies.h"

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
  // Non-degenerate instances by partition, at the end those of the global one.
  std::vector<uint32_t> members;
  // What rays meet, by InstanceIndex: with translations, and inactive where nothing can be hit.
  std::vector<Instance> instances;
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

// Runs an operation of type kPartitionedTlas. What is wrong in GPU memory is a warning, KA0788 or
// KA0797. Errors: KA0795 the destination is too small, and the backend's.
rtapi::Status build_partitioned(const StructureEnvironment& environment,
                                const RtasOperation& operation, OperationNotes& notes,
                                const RebuildLevel& build);

}  // namespace kaamos::runtime
