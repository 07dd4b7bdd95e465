// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Runs ExecuteIndirectRTASOperations: the same for all backends, but for the levels
// that rays traverse. [DXR 2.0: ExecuteIndirectRTASOperations]
#pragma once

#include <string>

#include <rtapi/result.h>

#include "runtime/backend/commands.h"
#include "runtime/structures/structure_commands.h"
#include "runtime/structures/structure_copies.h"

namespace kaamos::runtime {

// The operations in order, but in another one in checked mode. All earlier commands are done, so
// that the host sees GPU memory as the operations do. An error removes the device; what is wrong in
// GPU memory is a warning.
rtapi::Status execute_operations(const StructureEnvironment& environment,
                                 const RtasOperationsCommand& command, const std::string& label,
                                 const RebuildLevel& build);

}  // namespace kaamos::runtime
