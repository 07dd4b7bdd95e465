// SPDX-License-Identifier: MIT
//
// Payloads, attributes and callable data as HLSL fields.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <rtapi/explain.h>

namespace kaamos::explain {

// The fields of `layout` (shader::ExportDesc::payload_layout) that are in the first `byte_count`
// bytes. Without a layout: each DWORD as a hexadecimal number.
std::vector<rtapi::ExplainedValue> decode_values(const char* layout, const void* bytes,
                                                 uint32_t byte_count);

// The shortest text that reads back as the same float.
std::string number_text(float value);

// "FORCE_OPAQUE | CULL_BACK_FACING_TRIANGLES", "NONE"; undefined bits appear as a number.
std::string ray_flags_text(uint32_t flags);

}  // namespace kaamos::explain
