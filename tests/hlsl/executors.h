// SPDX-License-Identifier: MIT
//
// The ways to run HLSL: from compiler options to a library that a backend's device can run.
#pragma once

#include <kaamos/shader/abi.h>

#include <memory>
#include <string>
#include <vector>

#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/ir/result.h"

namespace kaamos::test {

struct Compiled {
  const shader::LibraryDesc* library = nullptr;  // null if it does not compile; `error` says why
  std::string error;
  std::shared_ptr<const void> owner;  // keeps the library loaded; null if it stays loaded anyway
};

hlsl::Result<std::unique_ptr<hlsl::ir::Module>> compile_module(
    const hlsl::FrontendOptions& options);
// For the interpreter of the intermediate representation, on the Embree backend.
Compiled compile_interpreted(const hlsl::FrontendOptions& options);
// To native code, all in one shared object that stays loaded: starting the C++ compiler costs more
// than compiling a small shader.
std::vector<Compiled> compile_native(const std::vector<hlsl::FrontendOptions>& sources,
                                     hlsl::WideThreads wide = hlsl::WideThreads::kWhereFaster);
// To SPIR-V, without native code.
Compiled compile_vulkan(const hlsl::FrontendOptions& options);

}  // namespace kaamos::test
