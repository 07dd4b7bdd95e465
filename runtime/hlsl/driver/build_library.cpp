// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/build_library.h"

#include <kaamos/shader/abi.h>

#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/glsl/emit_glsl.h"
#include "runtime/hlsl/glsl/spirv.h"

namespace kaamos::hlsl {

namespace {

// The text of everything that the library is built of. The GLSL takes the place of the SPIR-V,
// because SPIR-V takes many times longer to make.
std::string content_of(const ir::Module& module, const std::string& cpp, bool spirv) {
  std::string content = cpp;
  if (!spirv) return content;
  for (const ir::EntryPoint& entry : module.entry_points) {
    content += emit_glsl(module, entry).text;
    if (has_twin(module, entry)) content += emit_glsl_twin(module, entry).text;
  }
  return content + spirv_version();
}

SharedObject build_quickly(const HostCompiler& compiler, const ir::Module& module,
                           BuildOptions options) {
  options.quick = false;
  const std::string full = content_of(
      module,
      emit_cpp(module, {.wide = options.wide ? WideThreads::kWhereFaster : WideThreads::kNever}),
      options.spirv);
  SharedObject out;
  out.path = find_shared_object(compiler, full, Optimisation::kFull, options.cache);
  out.from_cache = true;
  if (!out.path.empty()) return out;
  options.optimisation = Optimisation::kQuick;
  return build_library(compiler, module, options);
}

}  // namespace

SharedObject build_library(const HostCompiler& compiler, const ir::Module& module,
                           const BuildOptions& options) {
  const uint32_t flags =
      options.optimisation == Optimisation::kDebug ? uint32_t{shader::kLibraryDebug} : 0u;
  if (options.quick) return build_quickly(compiler, module, options);
  // A debugger should show one thread after another, and the code for eight at once takes as long
  // to compile as all the rest.
  const bool is_wide = options.wide && options.optimisation == Optimisation::kFull;
  const WideThreads wide = is_wide ? WideThreads::kWhereFaster : WideThreads::kNever;
  const std::string cpp = emit_cpp(module, {.flags = flags, .wide = wide});
  const std::string content = content_of(module, cpp, options.spirv);
  const auto make_source = [&](BuildFailure& error) -> std::string {
    if (!options.spirv) return cpp;
    const SpirvLibrary spirv = compile_spirv(module);
    error = spirv.error;
    if (error) return {};
    return emit_cpp(module, {.spirv = spirv.modules, .flags = flags, .wide = wide});
  };
  return build_shared_object(compiler, content, make_source, options.optimisation, options.cache);
}

}  // namespace kaamos::hlsl
