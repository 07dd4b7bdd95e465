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
  // If not empty: in what the variant falls short, and why, e.g. that there is no C++ compiler.
  std::string note;
  bool checked = false;
};

// `spirv`: for a Vulkan device. Built by the machine's C++ compiler and cached by content, like
// libraries compiled at run time; interpreted on the CPU if there is no compiler.
CheckedLibrary checked_variant(const ShaderLibrary& library, bool spirv);

}  // namespace rtapi::detail
