// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Operations that make clusters, and bottom levels of them.
// [DXR 2.0: Clustered geometry]
#pragma once

#include <vector>

#include <rtapi/result.h>

#include "runtime/backend/commands.h"
#include "runtime/operations/notes.h"
#include "runtime/structures/structure_commands.h"
#include "runtime/structures/structure_copies.h"

namespace kaamos::runtime {

// Runs an operation that is not kPartitionedTlas. What is wrong in GPU memory is a warning, KA0788,
// and leaves the argument or the operation out. Errors: the backend's, but for KA0794, which is a
// warning here.
rtapi::Status run_cluster_operation(const StructureEnvironment& environment,
                                    const RtasOperation& operation, OperationNotes& notes,
                                    const RebuildLevel& build, std::vector<RtasResult>& results);

}  // namespace kaamos::runtime
