// SPDX-License-Identifier: MIT
//
// The checked variant of a shader library: its embedded source, compiled again with -check-access
// when a checked device first uses it.
#pragma once

#include <string>

#include <rtapi/result.h>
#include <rtapi/shader_library.h>

namespace rtapi::detail {

struct CheckedLibrary {
  ShaderLibrary library;  // the variant; the library itself if there can be none
  std::string unchecked;  // if not empty: why there can be none
  std::string slow;       // if not empty: why the variant is interpreted, as in ModuleLibrary
};

// `spirv`: for a Vulkan device. Built by the machine's C++ compiler and cached by content, like
// libraries compiled at run time; interpreted on the CPU if there is no compiler.
CheckedLibrary checked_variant(const ShaderLibrary& library, bool spirv);

}  // namespace rtapi::detail
