// SPDX-License-Identifier: MIT
#include "d3d12/container/shader_bytecode.h"

#include <array>
#include <map>
#include <memory>
#include <mutex>

#include <rtapi/error_ids.h>

#include "d3d12/container/checksum.h"
#include "d3d12/container/shader_source.h"

namespace kaamos::d3d12 {

namespace {

// Returns whether the source compiles but cannot be built on this machine.
bool cannot_be_built(const rtapi::Status& status) {
  return !status.ok() && (status.error().id == rtapi::error_ids::compiler::kNoCompiler ||
                          status.error().id == rtapi::error_ids::compiler::kCompilerFailed);
}

rtapi::Result<rtapi::ShaderLibrary> compile(const void* bytes, size_t size, Reporter& reporter) {
  auto source = source_of_container(bytes, size);
  if (!source) return source.error();
  rtapi::ShaderCompileOptions options = compile_options(*std::move(source));
  rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);
  if (cannot_be_built(compiled.Status)) {
    const std::string who = "\"" + options.File + "\", and what else fails this way, runs about ";
    reporter.report_interpreted(
        make_error(ErrorId::kInterpreted,
                   who + "a hundred times slower on the CPU: " + compiled.Status.error().message));
    options.Interpret = true;
    compiled = rtapi::CompileShaderLibrary(options);
  }
  if (!compiled.Status.ok()) return compiled.Status.error();
  return compiled.Library;
}

struct LoadedShader {
  std::mutex mutex;
  rtapi::ShaderLibrary library;  // empty: not compiled yet, or it failed
};

struct LoadedShaders {
  std::mutex mutex;
  std::map<std::pair<size_t, std::array<uint32_t, 4>>, std::shared_ptr<LoadedShader>> shaders;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> load_shader(const void* bytes, size_t size,
                                                Reporter& reporter) {
  static LoadedShaders all;
  std::array<uint32_t, 4> digest{};
  if (bytes != nullptr) digest = md5({static_cast<const std::byte*>(bytes), size});
  std::shared_ptr<LoadedShader> shader;
  {
    std::lock_guard lock(all.mutex);
    std::shared_ptr<LoadedShader>& known = all.shaders[{bytes != nullptr ? size : 0, digest}];
    if (known == nullptr) known = std::make_shared<LoadedShader>();
    shader = known;
  }
  // Other shaders are compiled meanwhile.
  std::lock_guard lock(shader->mutex);
  if (!shader->library) {
    auto compiled = compile(bytes, size, reporter);
    if (!compiled) return compiled.error();
    shader->library = *std::move(compiled);
  }
  return shader->library;
}

}  // namespace kaamos::d3d12
