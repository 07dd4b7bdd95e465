// SPDX-License-Identifier: MIT
//
// What ClearUnorderedAccessViewUint and -Float write. [D3D12]
#pragma once

#include <cstdint>

#include <kaamos/shader/abi.h>
#include <rtapi/format.h>

namespace kaamos::runtime {

// The value as a typed store of HLSL gives it. Integers for a normalized format are bits: each
// channel takes the low ones of its value.
shader::Texel clear_texel(rtapi::Format format, bool is_float, const uint32_t values[4]);

// Writes every element of a view of a buffer whose address is as the host sees it.
void clear_buffer_view(const shader::Descriptor& view, bool is_float, const uint32_t values[4]);

}  // namespace kaamos::runtime
