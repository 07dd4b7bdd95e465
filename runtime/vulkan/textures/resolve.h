// SPDX-License-Identifier: MIT
//
// Resolves of multisampled images.
#pragma once

#include "runtime/backend/commands.h"
#include "runtime/vulkan/memory/command_stream.h"

namespace kaamos::vulkan {

// The average of samples.
rtapi::Status resolve(CommandStream& stream, const runtime::ResolveCommand& command);

}  // namespace kaamos::vulkan
