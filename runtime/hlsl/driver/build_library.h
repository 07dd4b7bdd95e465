// SPDX-License-Identifier: MIT
//
// Turns the intermediate representation into a shared object that holds the native code and the
// SPIR-V of every export.
#pragma once

#include <filesystem>

#include "runtime/hlsl/driver/host_compiler.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

struct BuildOptions {
  Optimisation optimisation = Optimisation::kFull;
  bool spirv = true;  // false: the library runs on the CPU only
  // Compute and ray generation shaders run several threads at once, except in a debug build.
  bool wide = true;
  // While a shader is being edited: built in half the time, one thread after another and with fewer
  // optimisations, unless the cache has the full build.
  bool quick = false;
  std::filesystem::path cache = cache_folder();
};

// Whatever the cache already has is neither compiled nor turned into SPIR-V again.
SharedObject build_library(const HostCompiler& compiler, const ir::Module& module,
                           const BuildOptions& options);

}  // namespace kaamos::hlsl
