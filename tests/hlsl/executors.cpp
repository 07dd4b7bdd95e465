// SPDX-License-Identifier: MIT
#include "executors.h"

#include <dlfcn.h>

#include <cstdlib>
#include <vector>

#include "runtime/hlsl/driver/host_compiler.h"
#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/glsl/spirv.h"
#include "runtime/hlsl/interpret/interpret.h"

namespace kaamos::test {
namespace {

// The interpreter's table of a module, with SPIR-V in place of its functions.
struct SpirvTables {
  std::shared_ptr<const hlsl::InterpretedLibrary> interpreted;
  hlsl::SpirvLibrary spirv;
  std::vector<shader::ExportDesc> exports;
  shader::LibraryDesc library = {};
};

shader::AnyFn no_code() {
  return reinterpret_cast<shader::AnyFn>(&std::abort);
}

}  // namespace

hlsl::Result<std::unique_ptr<hlsl::ir::Module>> compile_module(
    const hlsl::FrontendOptions& options) {
  hlsl::DiskFileLoader loader;
  hlsl::SourceManager sources(loader);
  hlsl::DiagnosticEngine diagnostics;
  auto module = hlsl::compile_to_ir(options, sources, diagnostics);
  if (!module) return hlsl::Failure{hlsl::render_all(diagnostics, sources)};
  return module;
}

Compiled compile_interpreted(const hlsl::FrontendOptions& options) {
  Compiled out;
  auto module = compile_module(options);
  out.error = module.error();
  if (!module) return out;
  const auto library = hlsl::InterpretedLibrary::create(*std::move(module), {});
  out.error = library.error();
  if (!library) return out;
  out.library = &(*library)->desc();
  out.owner = *library;
  return out;
}

std::vector<Compiled> compile_native(const std::vector<hlsl::FrontendOptions>& sources,
                                     hlsl::WideThreads wide) {
  std::vector<Compiled> out(sources.size());
  const auto name_of = [](size_t i) { return "kaamos_test_native_" + std::to_string(i); };
  std::string text;
  for (size_t i = 0; i < sources.size(); ++i) {
    const auto module = compile_module(sources[i]);
    out[i].error = module.error();
    if (module) text += hlsl::emit_cpp(**module, {.entry_point = name_of(i), .wide = wide});
  }
  const auto compiler = hlsl::find_host_compiler();
  std::string error = compiler.error();
  hlsl::SharedObject object;
  if (compiler) {
    object = hlsl::build_shared_object(*compiler, text, hlsl::Optimisation::kFull,
                                       std::string(KAAMOS_BINARY_DIR) + "/shader-cache");
    error = object.error.message();
  }
  void* handle = error.empty() ? dlopen(object.path.c_str(), RTLD_NOW | RTLD_LOCAL) : nullptr;
  for (size_t i = 0; i < sources.size(); ++i) {
    if (!out[i].error.empty()) continue;
    void* entry = handle != nullptr ? dlsym(handle, name_of(i).c_str()) : nullptr;
    if (entry != nullptr) {
      out[i].library = reinterpret_cast<shader::LibraryEntryPointFn>(entry)();
    } else {
      out[i].error = error.empty() ? "the shared object lacks its entry" : error;
    }
  }
  return out;
}

Compiled compile_vulkan(const hlsl::FrontendOptions& options) {
  Compiled out;
  auto compiled = compile_module(options);
  out.error = compiled.error();
  if (!compiled) return out;
  const std::shared_ptr<const hlsl::ir::Module> module = *std::move(compiled);
  auto tables = std::make_shared<SpirvTables>();
  const auto interpreted = hlsl::InterpretedLibrary::create(module, {});
  out.error = interpreted.error();
  if (interpreted) tables->interpreted = *interpreted;
  tables->spirv = hlsl::compile_spirv(*module);
  if (tables->spirv.error) out.error = tables->spirv.error.message();
  if (!out.error.empty()) return out;
  tables->library = tables->interpreted->desc();
  for (uint32_t i = 0; i < tables->library.export_count; ++i) {
    shader::ExportDesc desc = tables->library.exports[i];
    for (size_t entry = 0; entry < module->entry_points.size(); ++entry) {
      if (module->entry_points[entry].name != desc.name) continue;
      if (desc.entry != nullptr) desc.entry = no_code();
      desc.spirv = tables->spirv.modules[entry].data();
      desc.spirv_words = static_cast<uint32_t>(tables->spirv.modules[entry].size());
    }
    tables->exports.push_back(desc);
  }
  tables->library.exports = tables->exports.data();
  out.library = &tables->library;
  out.owner = tables;
  return out;
}

}  // namespace kaamos::test
