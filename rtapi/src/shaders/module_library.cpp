// SPDX-License-Identifier: MIT
#include "rtapi/src/shaders/module_library.h"

#include <utility>

#include "rtapi/src/shaders/shader_library_impl.h"
#include "runtime/hlsl/driver/build_library.h"
#include "runtime/hlsl/driver/host_compiler.h"
#include "runtime/hlsl/glsl/spirv.h"
#include "runtime/hlsl/interpret/interpret.h"

namespace rtapi::detail {
namespace {

namespace hlsl = kaamos::hlsl;
namespace shader = kaamos::shader;

ShaderLibrary interpret(std::shared_ptr<const hlsl::ir::Module> module, bool spirv,
                        std::string& error) {
  hlsl::InterpretOptions options;
  if (spirv) {
    hlsl::SpirvLibrary compiled = hlsl::compile_spirv(*module);
    error = compiled.error.message();
    if (!error.empty()) return {};
    options.spirv = std::move(compiled.modules);
  }
  const auto interpreted = hlsl::InterpretedLibrary::create(std::move(module), options, error);
  if (interpreted == nullptr) return {};
  const auto library = LoadShaderLibrary(&interpreted->desc(), interpreted);
  if (library.ok()) return *library;
  error = library.error().message;
  return {};
}

ShaderLibrary build(const hlsl::HostCompiler& compiler, const hlsl::ir::Module& module, bool spirv,
                    bool debug, std::string& error) {
  hlsl::BuildOptions options;
  options.spirv = spirv;
  // A Vulkan device runs the SPIR-V; the native code next to it only has to exist.
  options.optimisation = debug   ? hlsl::Optimisation::kDebug
                         : spirv ? hlsl::Optimisation::kNone
                                 : hlsl::Optimisation::kFull;
  const hlsl::SharedObject object = hlsl::build_library(compiler, module, options);
  error = object.error.message();
  if (!error.empty()) return {};
  const auto library = LoadShaderLibraryFromFile(object.path.string());
  if (library.ok()) return *library;
  error = library.error().message;
  return {};
}

}  // namespace

ModuleLibrary library_of(std::shared_ptr<const hlsl::ir::Module> module, uint32_t flags,
                         bool spirv) {
  ModuleLibrary out;
  const bool interpreted = (flags & shader::kLibraryInterpreted) != 0;
  const bool debug = (flags & shader::kLibraryDebug) != 0;
  std::string missing;
  if (!interpreted) {
    if (const auto compiler = hlsl::find_host_compiler(missing)) {
      out.library = build(*compiler, *module, spirv, debug, missing);
    }
  }
  if (!out.library) {
    out.library = interpret(std::move(module), spirv, out.error);
    if (!interpreted && !spirv) out.slow = missing;
  }
  return out;
}

}  // namespace rtapi::detail
