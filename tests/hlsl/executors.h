// SPDX-License-Identifier: MIT
//
// The ways to run HLSL: from options of the compiler to a library that a device of a backend runs.
#pragma once

#include <kaamos/shader/abi.h>

#include <memory>
#include <string>
#include <vector>

#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/driver/frontend.h"

namespace kaamos::test {

struct Compiled {
  const shader::LibraryDesc* library = nullptr;  // null with `error` where it does not compile
  std::string error;
  std::shared_ptr<const void> owner;  // of the library, unless it stays loaded
};

std::unique_ptr<hlsl::ir::Module> compile_module(const hlsl::FrontendOptions& options,
                                                 std::string& error);
// By the interpreter of the intermediate representation, on the Embree backend.
Compiled compile_interpreted(const hlsl::FrontendOptions& options);
// To native code, all in one shared object, which stays loaded: starting the C++ compiler costs
// more than a small shader.
std::vector<Compiled> compile_native(const std::vector<hlsl::FrontendOptions>& sources,
                                     hlsl::WideThreads wide = hlsl::WideThreads::kWhereFaster);
// To SPIR-V; there is no native code in it.
Compiled compile_vulkan(const hlsl::FrontendOptions& options);

}  // namespace kaamos::test
