// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "runtime/backend/linked_pipeline.h"

namespace kaamos::runtime {

// Checks that the waves of a device, which have from `least` to `most` lanes, can be as the
// shader's [WaveSize] asks; `device` says how they are, for the error KA0550.
rtapi::Status check_wave_size(const LinkedCompute& pipeline, uint32_t least, uint32_t most,
                              const std::string& device);

// Checks that the groupshared memory of the shader is at most what a group of the device has, in
// bytes. Errors: KA0552.
rtapi::Status check_groupshared(const LinkedCompute& pipeline, uint64_t most_bytes);

}  // namespace kaamos::runtime
