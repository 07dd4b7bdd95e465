// SPDX-License-Identifier: MIT
//
// Clears views as ClearUnorderedAccessViewUint and ClearUnorderedAccessViewFloat do. [D3D12]
#pragma once

#include <cstdint>

#include <kaamos/shader/abi.h>
#include <rtapi/format.h>

namespace kaamos::runtime {

// Converts the value as a typed store in HLSL would. For a normalized format integers are bit
// patterns: each channel takes the low bits of its value.
shader::Texel clear_texel(rtapi::Format format, bool is_float, const uint32_t values[4]);

// Writes every element of a buffer view. The view's address must be a host address.
void clear_buffer_view(const shader::Descriptor& view, bool is_float, const uint32_t values[4]);

}  // namespace kaamos::runtime
