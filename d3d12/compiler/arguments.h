// SPDX-License-Identifier: MIT
// DXC's command line, for kaamos-dxc and for IDxcCompiler::Compile.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <rtapi/shader_compiler.h>

namespace kaamos::d3d12 {

struct DxcArguments {
  rtapi::ShaderCompileOptions options;  // File is the positional argument
  bool warnings_as_errors = false;
  bool debug_info = false;      // -Zi
  bool absolute_paths = false;  // -Zi, -Od: for a debugger, wherever it runs
  bool help = false;
  bool version = false;
  bool preprocess = false;  // -P
  // Files to write; empty: none.
  std::string object;              // -Fo
  std::string header;              // -Fh
  std::string variable;            // -Vn; empty: g_ENTRY
  std::string debug_file;          // -Fd: a name only
  std::string errors;              // -Fe
  std::string listing;             // -Fc
  std::string hash;                // -Fsh
  std::string preprocessed;        // -P FILE, -Fi
  std::string dependency_file;     // -MF, -MD
  bool dependencies = false;       // -M: a make rule to standard output
  std::vector<std::string> notes;  // warnings about the arguments
};

/// Reads words as DXC does: -T lib_6_3, -Tlib_6_3, /T lib_6_3. A word that begins with / and names
/// a file, or has another / and cannot be an option, is a path.
/// @errors KA4024 names the argument.
rtapi::Result<DxcArguments> parse_dxc_arguments(const std::vector<std::string>& words);

/// Returns the text that -help prints.
std::string dxc_help();

}  // namespace kaamos::d3d12
