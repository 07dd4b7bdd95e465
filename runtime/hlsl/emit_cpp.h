// SPDX-License-Identifier: MIT
//
// Prints a module of the intermediate representation as one C++ translation unit on top of
// <kaamos/shader/prelude.h>. The unit has one function with external linkage that returns the
// library's table (shader::LibraryDesc).
#pragma once

#include <string>

#include "runtime/hlsl/ir.h"

namespace kaamos::hlsl {

struct EmitCppOptions {
  // Name of the table's function. Libraries of one program need different names; a library that is
  // loaded at run time has shader::kLibraryEntryPoint.
  std::string entry_point = "kaamos_shader_library";
  bool line_directives = true;  // `#line`: a debugger and a profiler show the HLSL source
};

// The module must come from the checker without errors; emission cannot fail.
std::string emit_cpp(const ir::Module& module, const EmitCppOptions& options);

}  // namespace kaamos::hlsl
