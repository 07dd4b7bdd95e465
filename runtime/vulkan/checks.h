// SPDX-License-Identifier: MIT
//
// Checked devices: what instrumented SPIR-V reads and where it tells what it found, and the telling
// of it when a dispatch is over.
#pragma once

#include <span>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/checks/code_findings.h"
#include "runtime/vulkan/dispatch.h"

namespace kaamos::vulkan {

// The CheckState of a dispatch that is about to run; 0 where the device is not checked.
rtapi::Result<uint64_t> begin_checks(const DispatchEnvironment& environment,
                                     uint32_t max_recursion_depth);
// When it has run. `shaders`: by kShaderConstant - 1; of `place` all but shader and index counts.
// Returns what was reached that was not known before.
std::vector<runtime::ReachedFrom> tell_checks(const DispatchEnvironment& environment,
                                              std::span<const runtime::LinkedShader* const> shaders,
                                              checks::CodePlace place);
// Then: only shaders can tell, and what they know is that a ray or call ran nothing.
runtime::MissingRecords missing_records(const DispatchEnvironment& environment);

}  // namespace kaamos::vulkan
