// SPDX-License-Identifier: MIT
//
// Builds on Embree; what does not depend on it is in runtime/structure_commands.h.
#pragma once

#include <rtapi/result.h>

#include "runtime/backend/commands.h"

namespace kaamos::embree {

class Device;

// Errors remove the device; whatever does no harm is a message.
rtapi::Status build(Device& device, const runtime::BuildCommand& command);
rtapi::Status copy(Device& device, const runtime::CopyAccelerationStructureCommand& command);
// Before a dispatch. [runtime::complete_top_levels]
rtapi::Status complete_top_levels(Device& device);

}  // namespace kaamos::embree
