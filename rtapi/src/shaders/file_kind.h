// SPDX-License-Identifier: MIT
//
// Names the kind of a file, for messages about files of the wrong kind.
#pragma once

#include <string>

namespace rtapi::detail {

// "a DXIL container, which dxc makes for Direct3D drivers", "HLSL or other text", .. by the first
// bytes of the file.
std::string describe_file(const std::string& path);

}  // namespace rtapi::detail
