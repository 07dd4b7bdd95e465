// SPDX-License-Identifier: MIT
//
// Checked devices: the memory that instrumented SPIR-V reads and writes its findings to, and the
// reports made from it after a dispatch.
#pragma once

#include <span>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/checks/code_findings.h"
#include "runtime/vulkan/rays/dispatch.h"

namespace kaamos::vulkan {

// The address of the CheckState for a dispatch that is about to run; 0 if the device is not
// checked.
rtapi::Result<uint64_t> begin_checks(const DispatchEnvironment& environment,
                                     uint32_t max_recursion_depth);
// Reports the findings after the dispatch has run. `shaders` is indexed by kShaderConstant - 1;
// `place` has everything but shader and index. Returns calls that were unknown before the dispatch.
std::vector<runtime::ReachedFrom> tell_checks(const DispatchEnvironment& environment,
                                              std::span<const runtime::LinkedShader* const> shaders,
                                              checks::CodePlace place);
// After that. Only shaders can tell, and all they know is that a ray or call ran nothing.
runtime::MissingRecords missing_records(const DispatchEnvironment& environment);

}  // namespace kaamos::vulkan
