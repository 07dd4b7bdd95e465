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

using Built = hlsl::Result<ShaderLibrary>;

Built loaded(const Result<ShaderLibrary>& library) {
  if (library.ok()) return *library;
  return hlsl::Failure{library.error().message};
}

Built interpret(std::shared_ptr<const hlsl::ir::Module> module, bool spirv) {
  hlsl::InterpretOptions options;
  if (spirv) {
    hlsl::SpirvLibrary compiled = hlsl::compile_spirv(*module);
    if (compiled.error) return hlsl::Failure{compiled.error.message()};
    options.spirv = std::move(compiled.modules);
  }
  const auto interpreted = hlsl::InterpretedLibrary::create(std::move(module), options);
  if (!interpreted) return hlsl::Failure{interpreted.error()};
  return loaded(load_library(&(*interpreted)->desc(), (*interpreted)->coverage(), *interpreted,
                             "interpreted library"));
}

Built build(const hlsl::ir::Module& module, bool spirv, bool debug) {
  const auto compiler = hlsl::find_host_compiler();
  if (!compiler) return hlsl::Failure{compiler.error()};
  hlsl::BuildOptions options;
  options.spirv = spirv;
  // A Vulkan device runs the SPIR-V; the native code next to it only has to exist.
  options.optimisation = debug   ? hlsl::Optimisation::kDebug
                         : spirv ? hlsl::Optimisation::kNone
                                 : hlsl::Optimisation::kFull;
  const hlsl::SharedObject object = hlsl::build_library(*compiler, module, options);
  if (object.error) return hlsl::Failure{object.error.message()};
  return loaded(LoadShaderLibraryFromFile(object.path.string()));
}

}  // namespace

ModuleLibrary library_of(std::shared_ptr<const hlsl::ir::Module> module, uint32_t flags,
                         bool spirv) {
  ModuleLibrary out;
  if ((flags & shader::kLibraryInterpreted) == 0) {
    const Built built = build(*module, spirv, (flags & shader::kLibraryDebug) != 0);
    if (built) {
      out.library = *built;
      return out;
    }
    if (!spirv) out.slow = built.error();
  }
  const Built interpreted = interpret(std::move(module), spirv);
  if (interpreted) out.library = *interpreted;
  out.error = interpreted.error();
  return out;
}

}  // namespace rtapi::detail
