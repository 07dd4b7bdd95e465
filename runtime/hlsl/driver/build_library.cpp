// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/build_library.h"

#include <kaamos/shader/abi.h>

#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/glsl/emit_glsl.h"
#include "runtime/hlsl/glsl/spirv.h"

namespace kaamos::hlsl {

SharedObject build_library(const HostCompiler& compiler, const ir::Module& module,
                           const BuildOptions& options) {
  const uint32_t flags =
      options.optimisation == Optimisation::kDebug ? uint32_t{shader::kLibraryDebug} : 0u;
  // A debugger should show one thread after another.
  const bool is_wide = options.wide && flags != shader::kLibraryDebug;
  const WideThreads wide = is_wide ? WideThreads::kWhereFaster : WideThreads::kNever;
  std::string content = emit_cpp(module, {.flags = flags, .wide = wide});
  if (!options.spirv) {
    return build_shared_object(compiler, content, options.optimisation, options.cache);
  }
  // The GLSL takes the place of the SPIR-V in the key, because SPIR-V takes many times longer to
  // make.
  std::vector<GlslShader> shaders;
  for (const ir::EntryPoint& entry : module.entry_points) {
    shaders.push_back(emit_glsl(module, entry));
    content += shaders.back().text;
  }
  content += spirv_version();
  const auto make_source = [&](BuildFailure& error) -> std::string {
    std::vector<std::vector<uint32_t>> modules;
    for (size_t i = 0; i < shaders.size(); ++i) {
      SpirvModule spirv = compile_spirv(shaders[i], module.entry_points[i].name);
      if (spirv.error) {
        error = std::move(spirv.error);
        return {};
      }
      modules.push_back(std::move(spirv.words));
    }
    return emit_cpp(module, {.spirv = modules, .flags = flags, .wide = wide});
  };
  return build_shared_object(compiler, content, make_source, options.optimisation, options.cache);
}

}  // namespace kaamos::hlsl
