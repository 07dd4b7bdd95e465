// SPDX-License-Identifier: MIT
//
// Builds on Embree. Whatever does not depend on Embree is in
// runtime/structures/structure_commands.h.
#pragma once

#include <string>

#include <rtapi/result.h>

#include "runtime/backend/commands.h"

namespace kaamos::embree {

class Device;

// An error removes the device; anything harmless is a message.
rtapi::Status build(Device& device, const runtime::BuildCommand& command);
rtapi::Status copy(Device& device, const runtime::CopyAccelerationStructureCommand& command);
rtapi::Status execute_operations(Device& device, const runtime::RtasOperationsCommand& command,
                                 const std::string& label);
// To be called before a dispatch. [runtime::complete_structures]
rtapi::Status complete_structures(Device& device);

}  // namespace kaamos::embree
