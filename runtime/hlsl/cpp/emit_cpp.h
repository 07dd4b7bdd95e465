// SPDX-License-Identifier: MIT
//
// Prints a module of the intermediate representation as one C++ translation unit on top of
// <kaamos/shader/prelude.h>. The unit has one function with external linkage that returns the
// library's table (shader::LibraryDesc).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Compute and ray generation shaders that run several threads at once. [wide_plan.h]
enum class WideThreads : uint8_t {
  kNever,
  kWhereFaster,  // ray generation, and groups of as many threads
  kAlways,       // for tests: wherever it is possible
};

struct EmitCppOptions {
  // Name of the table's function. Libraries of one program need different names; a library that is
  // loaded at run time has shader::kLibraryEntryPoint.
  std::string entry_point = "kaamos_shader_library";
  bool line_directives = true;  // `#line`: a debugger and a profiler show the HLSL source
  // The SPIR-V of each entry point (spirv.h), for the table; empty: a library without it.
  std::span<const std::vector<uint32_t>> spirv = {};
  uint32_t flags = 0;        // shader::LibraryFlags besides kLibraryChecked
  bool split_groups = true;  // compute: cut at barriers where possible, else fibers
  WideThreads wide = WideThreads::kWhereFaster;
};

// The module must come from the checker without errors; emission cannot fail.
std::string emit_cpp(const ir::Module& module, const EmitCppOptions& options);

}  // namespace kaamos::hlsl
