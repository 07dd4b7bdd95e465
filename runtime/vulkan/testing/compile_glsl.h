// SPDX-License-Identifier: MIT
#pragma once

#include <volk.h>

#include <cstdint>
#include <string>
#include <vector>

namespace kaamos::vulkan::testing {

// SPIR-V of a shader of a test, entry point "main". Empty, and a failed expectation, for a mistake.
std::vector<uint32_t> compile_glsl(VkShaderStageFlagBits stage, const std::string& source);

}  // namespace kaamos::vulkan::testing
