// SPDX-License-Identifier: MIT
//
// The checked variant of a shader library: its embedded source compiled again with -check-access,
// when a checked device first uses it.
#pragma once

#include <string>

#include <rtapi/result.h>
#include <rtapi/shader_library.h>

namespace rtapi::detail {

struct CheckedLibrary {
  ShaderLibrary library;  // the variant; the same library where there is none to be had
  // Not empty: what is less than asked for, and why, e.g. that there is no C++ compiler.
  std::string note;
  bool checked = false;
};

// `spirv`: for a Vulkan device. Built by the machine's C++ compiler and cached by content, as
// libraries compiled at run time are; without a compiler interpreted on the CPU.
CheckedLibrary checked_variant(const ShaderLibrary& library, bool spirv);

}  // namespace rtapi::detail
