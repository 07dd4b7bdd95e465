// SPDX-License-Identifier: MIT
//
// Other code for a shader library than it carries: its embedded source, compiled when a device
// first uses it, or when a library that carries no code is loaded.
#pragma once

#include <string>

#include <kaamos/shader/abi.h>
#include <rtapi/result.h>
#include <rtapi/shader_library.h>

namespace rtapi::detail {

// What the code has besides.
struct VariantParts {
  bool checks = false;    // -check-access
  bool coverage = false;  // of $KAAMOS_COVERAGE

  auto operator<=>(const VariantParts&) const = default;
};

struct LibraryVariant {
  ShaderLibrary library;  // the variant; the library itself if there can be none
  std::string missing;    // if not empty: why there can be none
  std::string slow;       // if not empty: why the variant is interpreted, as in ModuleLibrary
};

// The library itself if it has all of `parts`. `spirv`: for a Vulkan device. Built by the machine's
// C++ compiler and cached by content, like libraries compiled at run time; interpreted on the CPU
// if there is no compiler.
LibraryVariant variant_of(const ShaderLibrary& library, VariantParts parts, bool spirv);

// The library that a table with kLibrarySource stands for, with SPIR-V if this build has Vulkan.
// Compiled once in a process, like libraries that are compiled at run time.
Result<ShaderLibrary> load_source_library(const kaamos::shader::LibraryDesc& desc);

}  // namespace rtapi::detail
