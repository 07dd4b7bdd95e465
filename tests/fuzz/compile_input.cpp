// SPDX-License-Identifier: MIT
#include "compile_input.h"

#include "interpret_input.h"
#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/driver/reflect.h"
#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/glsl/spirv.h"
#include "runtime/hlsl/ir/dump.h"
#include "runtime/hlsl/ir/verify.h"

namespace kaamos::test {

std::string compile_input(const Corpus& corpus, const std::vector<std::string>& include_folders,
                          const Input& input, uint64_t number, uint64_t choice, CppBatch* batch) {
  // Includes come from memory only: a damaged #include must not open files on the disk.
  hlsl::MemoryFileLoader loader(corpus.texts);
  hlsl::SourceManager sources(loader);
  hlsl::FrontendOptions options;
  options.path = input.path;
  options.text = input.text;
  options.include_folders = include_folders;
  const auto flag = [&choice](uint64_t one_in) {
    const bool set = choice % one_in == 0;
    choice /= one_in;
    return set;
  };
  options.strict = flag(4);
  options.native_16bit = flag(2);
  options.row_major = flag(4);
  options.external_linkage = flag(2);
  if (flag(4)) options.hlsl_version = 2018;
  if (flag(4)) options.target = "lib_6_7";
  if (flag(16)) options.target = "cs_6_0";
  if (flag(16)) options.exports = "Main;main=Other";
  options.check_access = flag(8);
  hlsl::EmitCppOptions cpp_options;
  if (flag(2)) cpp_options.wide = hlsl::WideThreads::kAlways;
  options.coverage = flag(8);
  hlsl::DiagnosticEngine diagnostics({.strict = options.strict});
  const std::shared_ptr<const hlsl::ir::Module> module =
      hlsl::compile_to_ir(options, sources, diagnostics);
  const std::string messages = hlsl::render_all(diagnostics, sources);
  if (diagnostics.has_errors() == (module != nullptr)) {
    return module != nullptr ? "a module in spite of errors:\n" + messages
                             : "no module, and no error that says why";
  }
  if (!module) return {};
  const std::string violations = hlsl::verify(*module);
  if (!violations.empty()) return "the module breaks rules of ir.h:\n" + violations;
  if (hlsl::dump(*module).empty()) return "an empty dump";
  if (hlsl::reflect_json(*module).empty()) return "no reflection";
  if (batch != nullptr) cpp_options.entry_point = batch->next_name();
  std::string cpp = hlsl::emit_cpp(*module, cpp_options);
  if (cpp.empty()) return "no C++";
  if (batch != nullptr) batch->add(number, std::move(cpp));
  if (!options.check_access) {
    const std::string interpreted = interpret_input(module);
    if (!interpreted.empty()) return interpreted;
  }
  return hlsl::compile_spirv(*module).error.message();
}

}  // namespace kaamos::test
