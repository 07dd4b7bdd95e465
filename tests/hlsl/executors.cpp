// SPDX-License-Identifier: MIT
#include "executors.h"

#include <cstdlib>
#include <vector>

#include "runtime/hlsl/file_loader.h"
#include "runtime/hlsl/interpret.h"
#include "runtime/hlsl/spirv.h"

namespace kaamos::test {
namespace {

// The interpreter's table of a module with SPIR-V in place of its functions.
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

std::unique_ptr<hlsl::ir::Module> compile_module(const hlsl::FrontendOptions& options,
                                                 std::string& error) {
  hlsl::DiskFileLoader loader;
  hlsl::SourceManager sources(loader);
  hlsl::DiagnosticEngine diagnostics;
  auto module = hlsl::compile_to_ir(options, sources, diagnostics);
  if (!module) error = hlsl::render_all(diagnostics, sources);
  return module;
}

Compiled compile_interpreted(const hlsl::FrontendOptions& options) {
  Compiled out;
  std::shared_ptr<const hlsl::ir::Module> module = compile_module(options, out.error);
  if (!module) return out;
  const auto library = hlsl::InterpretedLibrary::create(module, {}, out.error);
  if (!library) return out;
  out.library = &library->desc();
  out.owner = library;
  return out;
}

Compiled compile_vulkan(const hlsl::FrontendOptions& options) {
  Compiled out;
  std::shared_ptr<const hlsl::ir::Module> module = compile_module(options, out.error);
  if (!module) return out;
  auto tables = std::make_shared<SpirvTables>();
  tables->interpreted = hlsl::InterpretedLibrary::create(module, {}, out.error);
  tables->spirv = hlsl::compile_spirv(*module);
  if (!tables->spirv.error.empty()) out.error = tables->spirv.error;
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
