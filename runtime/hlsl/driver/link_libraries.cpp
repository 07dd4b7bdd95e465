// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/link_libraries.h"

#include "runtime/hlsl/driver/embedded_source.h"

namespace kaamos::hlsl {
namespace {

// The files of one library at a time: two may have other texts under one name.
class LibraryFiles : public FileLoader {
 public:
  std::optional<LoadedFile> load(const std::string& path, std::string* error) override {
    return current_->load(path, error);
  }
  void use(FileLoader& files) { current_ = &files; }

 private:
  FileLoader* current_ = nullptr;
};

}  // namespace

Result<std::unique_ptr<ir::Module>> link_libraries(const LinkRequest& request) {
  LibraryFiles files;
  SourceManager sources(files);
  DiagnosticEngine diagnostics({.strict = false});
  std::vector<std::unique_ptr<ParsedSource>> parsed;
  Link link;
  for (const LibrarySource& library : request.libraries) {
    auto source = read_embedded_source(library.text);
    if (!source) {
      return Failure{"its source cannot be read; was it made by another version of kaamos-hlsl?"};
    }
    source->options.strict = false;  // each has passed by itself
    source->options.coverage = request.coverage;
    sources.forget_paths();
    files.use(source->files);
    auto one = parse_source(source->options, sources, diagnostics);
    if (one == nullptr || diagnostics.has_errors()) {
      return Failure{"its source does not compile:\n" + render_all(diagnostics, sources)};
    }
    link.units.push_back({one->tree, one->options, library.registers});
    parsed.push_back(std::move(one));
  }
  link.entries = request.entries;
  link.definitions = request.definitions;
  auto module = check_linked(link, sources, diagnostics);
  if (module == nullptr) {
    Failure failure;
    for (const Diagnostic& diagnostic : diagnostics.diagnostics()) {
      if (diagnostic.severity == Severity::kError) failure.text += render(diagnostic, sources);
    }
    return failure;
  }
  module->check_access = request.check_access;
  return module;
}

}  // namespace kaamos::hlsl
