// SPDX-License-Identifier: MIT
// Texts of any encoding that dxcompiler takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace kaamos::d3d12 {

/// UTF-8 of a text in a code page (DXC_CP). A byte order mark, which decides the encoding for
/// DXC_CP_ACP, and zeros at the end are left out.
std::string decode_text(const void* bytes, size_t size, uint32_t code_page);

}  // namespace kaamos::d3d12
