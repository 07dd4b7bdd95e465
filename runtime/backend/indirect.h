// SPDX-License-Identifier: MIT
//
// Turns ExecuteIndirect into plain dispatches and draws: reads and checks the arguments, the same
// way for every backend. [DXR: D3D12_INDIRECT_ARGUMENT_TYPE]
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <rtapi/result.h>

#include "runtime/backend/address_map.h"
#include "runtime/backend/commands.h"

namespace kaamos::runtime {

// Runs a DispatchRaysCommand, DispatchCommand or DrawCommand; `index` counts within the
// ExecuteIndirect.
using RunIndirect = std::function<rtapi::Status(const Command& dispatch, uint32_t index)>;

// Runs the commands in order, skipping those with a count of zero. Everything that may write the
// buffers must be done. Error KA0898, which removes the device: arguments that break a rule.
// `label` names the command.
rtapi::Status execute_indirect(const AddressMap& addresses, const ExecuteIndirectCommand& command,
                               const std::string& label, const RunIndirect& run);

// "ray dispatch 2 of ExecuteIndirect, command 5", for a backend's messages.
std::string indirect_label(const char* what, uint32_t index, const std::string& label);

}  // namespace kaamos::runtime
