// SPDX-License-Identifier: MIT
/// @file
/// Compiling HLSL at run time, with the machine's C++ compiler and a cache by content, or for the
/// interpreter. In a library of its own (kaamos::hlsl), so that programs with built-in shaders need
/// no compiler.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <rtapi/result.h>
#include <rtapi/shader_library.h>
#include <rtapi/shader_reflection.h>

namespace rtapi {

/// A macro that is defined before the source is read.
struct ShaderDefine {
  std::string Name = {};    ///< of the macro
  std::string Value = "1";  ///< what it stands for
};

/// The text of a file, and the path by which the compiler asked for it: "shaders/a.hlsli" where
/// "shaders/main.hlsl" has `#include "a.hlsli"`.
struct ShaderSourceFile {
  std::string Path = {};  ///< with `/`
  std::string Text = {};  ///< as it was read
};

/// Says what to compile and how. The members are DXC's options by their meaning.
struct ShaderCompileOptions {
  std::string File = {};                   ///< the main source file; also names it in messages
  std::optional<std::string> Source = {};  ///< the text, instead of reading File
  std::string Target = "lib_6_6";          ///< -T: lib_6_3 to lib_6_10, cs_6_x, vs_6_x, ps_6_x
  std::string EntryPoint = {};             ///< -E, unless a library
  std::vector<ShaderDefine> Defines = {};  ///< -D
  std::vector<std::string> IncludeDirectories = {};  ///< -I
  /// Reads files instead of the disk, on the calling thread: the text at a path, or nothing if
  /// there is no file, and the next of IncludeDirectories is tried. Empty: the disk is read.
  std::function<std::optional<std::string>(const std::string& path)> ReadFile = {};
  std::vector<std::string> Exports = {};          ///< -exports "a;b=c"; empty: everything
  std::optional<uint32_t> AutoBindingSpace = {};  ///< -auto-binding-space
  std::string HlslVersion = "2021";               ///< -HV: "2018", or else 2021
  bool RowMajorMatrices = false;                  ///< -Zpr
  /// -flegacy-resource-reservation: resources that nothing reads keep their registers, as in shader
  /// model 5.0.
  bool ReserveUnusedRegisters = false;
  bool Native16BitTypes = false;  ///< -enable-16bit-types
  /// -enable-experimental: targets of shader model 6.10, whose specification still moves.
  bool Experimental = false;
  bool ExternalLinkage = false;  ///< -default-linkage external
  /// -enable-payload-qualifiers, -disable-payload-qualifiers; empty: on from lib_6_7.
  /// [DXR: Availability]
  std::optional<bool> PayloadQualifiers = {};
  bool Strict = false;            ///< --strict: refuse what DXC refuses
  bool WarningsAsErrors = false;  ///< -WX
  bool NoWarnings = false;        ///< -no-warnings: Diagnostics holds errors only
  bool CheckAccess = false;       ///< -check-access: for devices with DeviceDesc::Checked
  /// False is -no-source: checked devices and those with coverage cannot compile it anew, nor state
  /// objects link it with another library.
  bool EmbedSource = true;
  bool WideThreads = true;          ///< false is -no-wide: never eight threads at once
  bool CheckOnly = false;           ///< -check: nothing is made; Library stays empty
  bool Debug = false;               ///< -Od -Zi: for gdb
  std::string CacheDirectory = {};  ///< empty: $KAAMOS_CACHE_DIR, else the user's cache directory
  /// Empty: $KAAMOS_CXX, else the compiler that built Kaamos, c++, g++ or clang++.
  std::string CxxCompiler = {};
  bool Spirv = true;  ///< false: without what Vulkan devices need (KA0954)
  /// While a shader is being edited: half the C++ compiler's time, for code that runs one thread
  /// after another with fewer optimisations and gives the same results. If the cache has the
  /// library without this option, that is loaded.
  bool Quick = false;
  /// Needs no C++ compiler; on the CPU shaders run about a hundred times slower. No cache.
  bool Interpret = false;
  /// Statements that one shader invocation may run when interpreted, before the device is removed
  /// (KA0897: an endless loop); 0: about a thousand million.
  uint64_t InterpretStepLimit = 0;
};

/// The severity of a diagnostic. Errors stop compilation; warnings do with WarningsAsErrors.
enum class ShaderDiagnosticSeverity : uint32_t { kNote, kWarning, kError };

/// One thing that the compiler has to say about the source.
struct ShaderDiagnostic {
  ShaderDiagnosticSeverity Severity = ShaderDiagnosticSeverity::kError;  ///< how grave it is
  ErrorId Id;             ///< KA2104 is number 2104; all are in KA2000-2799
  std::string File = {};  ///< as the include that read it found it
  uint32_t Line = 0;      ///< from 1; 0 without a place
  uint32_t Column = 0;    ///< from 1
  std::string Message;    ///< without the place
  std::string Text;       ///< the whole of it as a terminal shows it: place, source line, caret
};

/// The result of a compilation.
struct ShaderCompilation {
  rtapi::Status Status;   ///< an error's message holds every error diagnostic's Text
  ShaderLibrary Library;  ///< empty on error
  std::vector<ShaderDiagnostic> Diagnostics;  ///< in the order in which they were found
  std::vector<std::string> Dependencies;      ///< every file read, the main one first
  /// The texts of all files that were read, by path; with Source, without the main one.
  std::vector<ShaderSourceFile> Sources;
  ShaderReflection Reflection;  ///< empty on error; with CheckOnly too
  bool FromCache = false;       ///< nothing had to be built
};

/// Compiles HLSL into a library for both backends and loads it. Takes the C++ compiler's time,
/// often seconds, unless the cache holds what the same source, options and compiler gave; a hit
/// takes about 1 ms. What works of HLSL is listed in runtime/hlsl/SUPPORT.md. With $KAAMOS_COVERAGE
/// (a path) the code collects which lines and branches run, and so does that of other libraries
/// when a device uses them; when a device or the process ends, they are added to the LCOV tracefile
/// at that path.
/// @errors in ShaderCompilation::Status: KA2752 the source does not compile, which the diagnostics
/// (KA2000-2799) explain; KA2750 no C++ compiler was found; KA2751 it failed; KA2753 the
/// interpreter cannot run the code; KA2760, KA2761 no SPIR-V could be made of it; KA0910 the result
/// cannot be loaded.
ShaderCompilation CompileShaderLibrary(const ShaderCompileOptions& options);

/// The result of preprocessing.
struct ShaderPreprocessing {
  rtapi::Status Status;  ///< an error's message holds every error diagnostic's Text
  std::string Text;      ///< with line directives; empty on error
  std::vector<ShaderDiagnostic> Diagnostics;  ///< in the order in which they were found
};

/// Runs the preprocessor alone [DXC: -P]: macros are expanded and files included. Of the options,
/// those of the source, of macros and files, Target and HlslVersion count.
/// @errors in ShaderPreprocessing::Status: KA2752 the source or the target is wrong, which the
/// diagnostics explain.
ShaderPreprocessing PreprocessShader(const ShaderCompileOptions& options);

}  // namespace rtapi
