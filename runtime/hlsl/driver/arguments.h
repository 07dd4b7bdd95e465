// SPDX-License-Identifier: MIT
//
// The command line of kaamos-hlsl: DXC's options by their names, and a few of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/hlsl/ir/result.h"

namespace kaamos::hlsl {

enum class Emit : uint8_t { kCpp, kSource, kIr, kReflection, kObject, kGlsl, kSpirv };

struct Arguments {
  std::string source;
  std::string target = "lib_6_6";
  std::string entry_point;
  std::vector<std::string> defines;
  std::vector<std::string> include_folders;
  std::string exports;
  bool external_linkage = false;
  uint32_t automatic_space = 0;
  uint32_t hlsl_version = 2021;
  bool native_16bit = false;
  bool experimental = false;
  bool row_major = false;
  bool reserve_unused = false;
  std::optional<bool> payload_qualifiers;
  bool strict = false;
  bool warnings_as_errors = false;
  bool no_warnings = false;
  bool debug = false;
  bool check_only = false;
  bool spirv = true;                 // in C++ and objects
  std::optional<bool> spirv_wanted;  // by -spirv or -no-spirv
  bool check_access = false;
  bool no_source = false;
  bool no_wide = false;
  Emit emit = Emit::kCpp;
  std::string output;           // empty: standard output; required with kObject
  std::string dependency_file;  // -MF: a makefile rule for ninja and make
  std::string entry_function = "kaamos_shader_library";
  bool help = false;
  bool version = false;
};

// A failure says which argument is wrong and what is allowed, and points to -help.
Result<Arguments> parse_arguments(const std::vector<std::string>& words);

const char* help_text();

}  // namespace kaamos::hlsl
