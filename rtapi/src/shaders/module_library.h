// SPDX-License-Identifier: MIT
//
// A shader library of a module that was compiled while a state object is made: a checked variant,
// or libraries that were linked.
#pragma once

#include <memory>
#include <string>

#include <rtapi/shader_library.h>

#include "runtime/hlsl/ir/ir.h"

namespace rtapi::detail {

struct ModuleLibrary {
  ShaderLibrary library;  // empty on failure
  std::string error;      // why
  // If not empty: why it is interpreted on the CPU although `flags` ask for native code, e.g. that
  // there is no C++ compiler.
  std::string slow;
};

// Built by the machine's C++ compiler and cached by content, like libraries compiled at run time;
// interpreted if it cannot be built. `flags`: kLibraryInterpreted and kLibraryDebug of the
// library that it stands for. `spirv`: for a Vulkan device.
ModuleLibrary library_of(std::shared_ptr<const kaamos::hlsl::ir::Module> module, uint32_t flags,
                         bool spirv);

}  // namespace rtapi::detail
