// SPDX-License-Identifier: MIT
//
// Native code of a module, by the machine's C++ compiler and the cache.
#pragma once

#include <string>

#include <rtapi/result.h>
#include <rtapi/shader_library.h>

#include "runtime/hlsl/driver/build_library.h"
#include "runtime/hlsl/ir/ir.h"

namespace rtapi::detail {

struct NativeLibrary {
  ShaderLibrary library;
  bool from_cache = false;
};

// `file` names the module in messages; `compiler` is ShaderCompileOptions::CxxCompiler.
Result<NativeLibrary> build_native(const std::string& file, const std::string& compiler,
                                   const kaamos::hlsl::ir::Module& module,
                                   const kaamos::hlsl::BuildOptions& options);

// What the compiler has to say about `file`.
Error make_compiler_error(const std::string& file, const kaamos::hlsl::BuildFailure& failure);

}  // namespace rtapi::detail
