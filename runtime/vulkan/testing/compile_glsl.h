// SPDX-License-Identifier: MIT
#pragma once

#include <volk.h>

#include <cstdint>
#include <string>
#include <vector>

namespace kaamos::vulkan::testing {

// Compiles a test's shader, entry point "main", to SPIR-V. On a mistake: empty, and a failed
// expectation.
std::vector<uint32_t> compile_glsl(VkShaderStageFlagBits stage, const std::string& source);

}  // namespace kaamos::vulkan::testing
