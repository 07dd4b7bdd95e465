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

// The compute and ray generation shaders that run several threads at once. [wide_plan.h]
enum class WideThreads : uint8_t {
  kNever,
  kWhereFaster,  // ray generation, and groups of at least as many threads
  kAlways,       // for tests: wherever possible
};

struct EmitCppOptions {
  // Name of the function that returns the table. Libraries linked into one program need different
  // names; a library that is loaded at run time uses shader::kLibraryEntryPoint.
  std::string entry_point = "kaamos_shader_library";
  bool line_directives = true;  // `#line`, so that a debugger or profiler shows the HLSL source
  // The SPIR-V of each entry point (spirv.h), for the table; if empty, the library has none.
  std::span<const std::vector<uint32_t>> spirv = {};
  uint32_t flags = 0;        // shader::LibraryFlags other than kLibraryChecked
  bool split_groups = true;  // compute: cut at barriers where possible, otherwise use fibers
  WideThreads wide = WideThreads::kWhereFaster;
};

// A unit whose table holds the module's source and no code (kLibrarySource): the code is compiled
// when a program loads the library.
std::string emit_source(const ir::Module& module, const std::string& entry_point);

// The module must have passed the checker without errors; emission cannot fail.
std::string emit_cpp(const ir::Module& module, const EmitCppOptions& options);

}  // namespace kaamos::hlsl
