// SPDX-License-Identifier: MIT
// Compiles a text to the intermediate representation and keeps its diagnostics.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/front/source.h"
#include "runtime/hlsl/ir/dump.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

class Compilation {
 public:
  explicit Compilation(std::string text, FrontendOptions options = {})
      : sources_(loader_), diagnostics_({.strict = options.strict, .error_limit = 50}) {
    options.path = "test.hlsl";
    options.text = std::move(text);
    module = compile_to_ir(options, sources_, diagnostics_);
  }

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_.diagnostics(); }
  ResolvedLocation resolve(SourceLocation location) const { return sources_.resolve(location); }
  std::string messages() const { return render_all(diagnostics_, sources_); }
  bool has(DiagnosticId id) const {
    for (const Diagnostic& diagnostic : diagnostics()) {
      if (diagnostic.id == id) return true;
    }
    return false;
  }
  // The dump of the function with that qualified name; empty if the module has none.
  std::string function(std::string_view name) const {
    if (!module) return messages();
    for (const ir::Function* one : module->functions) {
      if (one->name == name) return dump(*one);
    }
    return {};
  }

  std::unique_ptr<ir::Module> module;

 private:
  MemoryFileLoader loader_;
  SourceManager sources_;
  DiagnosticEngine diagnostics_;
};

// Wraps `body`, which may write `results`, in a kernel.
inline std::string kernel(const std::string& body, const std::string& globals = {}) {
  return globals +
         "\nRWByteAddressBuffer results : register(u0);\n[numthreads(1, 1, 1)]\n"
         "[shader(\"compute\")]\nvoid main() {\n" +
         body + "\n}\n";
}

}  // namespace kaamos::hlsl
