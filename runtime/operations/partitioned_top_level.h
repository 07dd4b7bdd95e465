// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Partitioned top levels: what the instances and partitions of one were last set to,
// and the operations that change them. [DXR 2.0: Partitioned TLAS]
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <rtapi/result.h>
#include <rtapi/rtas_operations.h>

#include "runtime/backend/commands.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/structure_commands.h"

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
  // What rays meet, by InstanceIndex: with translations, and inactive where nothing can be hit.
  std::vector<Instance> instances;
};

// What a backend makes of it: sets result.top_level and compacted_bytes. `changed` are the indices
// of the instances that differ from those of `previous`, the level at the destination that this one
// replaces in place; without one it is null, and all are new.
using BuildPartitioned = std::function<rtapi::Status(
    const PartitionedTopLevel& level, std::span<const uint32_t> changed,
    const std::shared_ptr<const TopLevelBase>& previous, AccelerationStructure& result)>;

// Runs an operation of type kPartitionedTlas. What is wrong in GPU memory is a warning, KA0788 or
// KA0797, that begins with `label`. Errors: KA0795 the destination is too small, and the backend's.
rtapi::Status build_partitioned(const StructureEnvironment& environment,
                                const RtasOperation& operation, const std::string& label,
                                const BuildPartitioned& build);

}  // namespace kaamos::runtime
