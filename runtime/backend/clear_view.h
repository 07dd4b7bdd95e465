// SPDX-License-Identifier: MIT
//
// Clears views as ClearUnorderedAccessViewUint and ClearUnorderedAccessViewFloat do. [D3D12]
#pragma once

#include <cstdint>

#include <kaamos/shader/abi.h>
#include <rtapi/format.h>

#include "runtime/backend/commands.h"

namespace kaamos::runtime {

// Converts floats as a typed store in HLSL would. Integers are bit patterns: each channel takes the
// low bits of its value, whatever the format.
shader::Texel clear_texel(rtapi::Format format, bool is_float, const uint32_t values[4]);

// Writes what a clear of a buffer view writes. `view` is the command's with a host address.
void clear_buffer_view(const shader::Descriptor& view, const ClearUavCommand& command);

// Returns the parts of a subresource of width x height that a clear writes. They may overlap.
std::vector<rtapi::Rect> cleared_parts(const ClearUavCommand& command, uint32_t width,
                                       uint32_t height);

}  // namespace kaamos::runtime
