// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. The operations that change partitioned top levels. [DXR 2.0: Partitioned TLAS]
#pragma once

#include <vector>

#include <rtapi/result.h>

#include "runtime/backend/commands.h"
#include "runtime/operations/notes.h"
#include "runtime/structures/partitioned_instances.h"
#include "runtime/structures/structure_commands.h"
#include "runtime/structures/structure_copies.h"

namespace kaamos::runtime {

// Runs an operation of type kPartitionedTlas; `results` gets what it placed. What is wrong in GPU
// memory is a warning, KA0788 or KA0797. Errors: KA0795 the destination is too small, and the
// backend's.
rtapi::Status build_partitioned(const StructureEnvironment& environment,
                                const RtasOperation& operation, OperationNotes& notes,
                                const RebuildLevel& build, std::vector<RtasResult>& results);

}  // namespace kaamos::runtime
