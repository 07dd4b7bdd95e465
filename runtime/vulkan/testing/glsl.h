// SPDX-License-Identifier: MIT
//
// GLSL to SPIR-V for tests whose shaders are written by hand.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kaamos/shader/abi.h"

namespace kaamos::vulkan::testing {

// Words of a module for Vulkan 1.3, entry point main. What spirv_interface.h defines stands before
// `body`: DispatchBlock `block`, Descriptor, Record `record` (not in compute and ray generation's
// callers need none), MAX_TRACE_DEPTH, WORKAROUNDS, binding_source(n) for n < 4. Empty after a test
// failure with glslang's messages.
std::vector<uint32_t> compile_glsl(shader::Stage stage, const std::string& body);

}  // namespace kaamos::vulkan::testing
