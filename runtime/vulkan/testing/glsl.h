// SPDX-License-Identifier: MIT
//
// Hand-written test shaders, on the interface that compiled HLSL uses.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kaamos/shader/abi.h"

namespace kaamos::vulkan::testing {

// Like compile_glsl, with the definitions of spirv_interface.h in front of `body`: DispatchBlock
// `block`, `record` except in compute, find_top_level, remove_device, MAX_TRACE_DEPTH,
// MAX_CALLABLE_DEPTH, WORKAROUNDS, binding_source_0 and binding_offset_0.
std::vector<uint32_t> compile_shader(shader::Stage stage, const std::string& body);

}  // namespace kaamos::vulkan::testing
