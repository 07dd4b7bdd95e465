// SPDX-License-Identifier: MIT
//
// Compiling HLSL at run time, with the machine's C++ compiler and a cache by content, or for the
// interpreter. In a library of its own (kaamos::hlsl), so that programs with built-in shaders need
// no compiler.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <rtapi/result.h>
#include <rtapi/shader_library.h>

namespace rtapi {

struct ShaderDefine {
  std::string Name = {};
  std::string Value = "1";
};

// The members are DXC's options by their meaning.
struct ShaderCompileOptions {
  std::string File = {};                   // the main source file; also names it in messages
  std::optional<std::string> Source = {};  // the text, instead of reading File
  std::string Target = "lib_6_6";          // -T
  std::string EntryPoint = {};             // -E, for cs_6_x
  std::vector<ShaderDefine> Defines = {};  // -D
  std::vector<std::string> IncludeDirectories = {};  // -I
  std::vector<std::string> Exports = {};             // -exports "a;b=c"; empty: everything
  std::optional<uint32_t> AutoBindingSpace = {};     // -auto-binding-space
  std::string HlslVersion = "2021";                  // -HV
  bool RowMajorMatrices = false;                     // -Zpr
  // -enable-payload-qualifiers, -disable-payload-qualifiers; empty: on from lib_6_7.
  std::optional<bool> PayloadQualifiers = {};
  bool Strict = false;              // --strict: refuse what DXC refuses
  bool WarningsAsErrors = false;    // -WX
  bool Debug = false;               // -Od -Zi: for gdb
  std::string CacheDirectory = {};  // empty: $KAAMOS_CACHE_DIR, else the user's cache directory
  std::string CxxCompiler = {};     // empty: $KAAMOS_CXX, $CXX, else c++, g++, clang++
  bool Spirv = true;                // false: without what Vulkan devices need
  // Needs no C++ compiler; on the CPU shaders run about a hundred times slower. No cache.
  bool Interpret = false;
  // Statements that one shader invocation may run when interpreted, before the device is removed
  // (an endless loop); 0: about a thousand million.
  uint64_t InterpretStepLimit = 0;
};

enum class ShaderDiagnosticSeverity : uint32_t { kNote, kWarning, kError };

struct ShaderDiagnostic {
  ShaderDiagnosticSeverity Severity = ShaderDiagnosticSeverity::kError;
  ErrorId Id;  // KA2104 is number 2104
  std::string File = {};
  uint32_t Line = 0;    // from 1; 0 without a place
  uint32_t Column = 0;  // from 1
  std::string Message;
  std::string Text;  // the whole of it as a terminal shows it: place, source line, caret
};

struct ShaderCompilation {
  rtapi::Status Status;   // an error's message holds every error diagnostic's Text
  ShaderLibrary Library;  // empty on error
  std::vector<ShaderDiagnostic> Diagnostics;
  std::vector<std::string> Dependencies;  // every file read, the main one first
  bool FromCache = false;
};

ShaderCompilation CompileShaderLibrary(const ShaderCompileOptions& options);

}  // namespace rtapi
