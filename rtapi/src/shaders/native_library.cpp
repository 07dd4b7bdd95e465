// SPDX-License-Identifier: MIT
#include "rtapi/src/shaders/native_library.h"

#include "rtapi/src/errors/error_table.h"
#include "runtime/hlsl/driver/host_compiler.h"
#include "runtime/hlsl/glsl/spirv.h"

namespace rtapi::detail {

namespace hlsl = kaamos::hlsl;

// The compiler, which knows nothing of rtapi, has numbers.
static_assert(hlsl::kSpirvFailed == static_cast<uint16_t>(Id::kSpirvFailed) &&
              hlsl::kSpirvBindings == static_cast<uint16_t>(Id::kSpirvBindings));

Error make_compiler_error(const std::string& file, const hlsl::BuildFailure& failure) {
  const auto id = failure.id == 0 ? Id::kCompilerFailed : Id(failure.id);
  return make_error(id, file, ": ", failure.text);
}

Result<NativeLibrary> build_native(const std::string& file, const std::string& compiler,
                                   const hlsl::ir::Module& module,
                                   const hlsl::BuildOptions& options) {
  const auto found = hlsl::find_host_compiler(compiler);
  if (!found) {
    return make_error(Id::kNoCompiler, found.error(),
                      "; without one, ShaderCompileOptions::Interpret runs shaders, slowly");
  }
  const hlsl::SharedObject object = hlsl::build_library(*found, module, options);
  if (object.error) return make_compiler_error(file, object.error);
  const auto library = LoadShaderLibraryFromFile(object.path.string());
  if (!library) return library.error();
  return NativeLibrary{*library, object.from_cache};
}

}  // namespace rtapi::detail
