// SPDX-License-Identifier: MIT
#include <rtapi/shader_compiler.h>

#include <filesystem>

#include "rtapi/src/errors/error_table.h"
#include "rtapi/src/shaders/native_library.h"
#include "rtapi/src/shaders/shader_library_impl.h"
#include "rtapi/src/shaders/shader_reflection.h"
#include "runtime/coverage/collector.h"
#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/front/print_tokens.h"
#include "runtime/hlsl/glsl/spirv.h"
#include "runtime/hlsl/interpret/interpret.h"

namespace rtapi {
namespace {

using namespace kaamos;

hlsl::FrontendOptions frontend_options(const ShaderCompileOptions& options) {
  hlsl::FrontendOptions out;
  out.path = options.File;
  out.text = options.Source;
  out.include_folders = options.IncludeDirectories;
  for (const ShaderDefine& define : options.Defines) {
    out.defines.push_back(define.Name + "=" + define.Value);
  }
  out.target = options.Target;
  if (!options.EntryPoint.empty()) out.entry_point = options.EntryPoint;
  for (const std::string& name : options.Exports) {
    out.exports += (out.exports.empty() ? "" : ";") + name;
  }
  out.automatic_space = options.AutoBindingSpace.value_or(0);
  out.hlsl_version = options.HlslVersion == "2018" ? 2018 : 2021;
  out.row_major = options.RowMajorMatrices;
  out.reserve_unused = options.ReserveUnusedRegisters;
  out.payload_qualifiers = options.PayloadQualifiers;
  out.native_16bit = options.Native16BitTypes;
  out.experimental = options.Experimental;
  out.external_linkage = options.ExternalLinkage;
  out.check_access = options.CheckAccess;
  out.coverage = coverage::is_asked();
  out.embed_source = options.EmbedSource;
  out.strict = options.Strict;
  return out;
}

// Files that the application has.
class CallbackLoader : public hlsl::FileLoader {
 public:
  explicit CallbackLoader(const ShaderCompileOptions& options) : options_(options) {}
  std::optional<hlsl::LoadedFile> load(const std::string& path, std::string*) override {
    std::optional<std::string> text = options_.ReadFile(path);
    if (!text) return std::nullopt;
    return hlsl::LoadedFile{path, hlsl::normalize_path(path), std::move(*text)};
  }

 private:
  const ShaderCompileOptions& options_;
};

// Chooses what reads the files: the application, or the disk.
class Loaders {
 public:
  explicit Loaders(const ShaderCompileOptions& options) : options_(options), callback_(options) {}
  hlsl::FileLoader& chosen() {
    if (options_.ReadFile) return callback_;
    return disk_;
  }

 private:
  const ShaderCompileOptions& options_;
  CallbackLoader callback_;
  hlsl::DiskFileLoader disk_;
};

ShaderDiagnosticSeverity severity_of(hlsl::Severity severity) {
  switch (severity) {
    case hlsl::Severity::kWarning:
      return ShaderDiagnosticSeverity::kWarning;
    case hlsl::Severity::kError:
      return ShaderDiagnosticSeverity::kError;
    default:
      return ShaderDiagnosticSeverity::kNote;
  }
}

std::vector<ShaderDiagnostic> convert(const hlsl::DiagnosticEngine& engine,
                                      const hlsl::SourceManager& sources, bool only_errors) {
  std::vector<ShaderDiagnostic> out;
  for (const hlsl::Diagnostic& diagnostic : engine.diagnostics()) {
    if (only_errors && diagnostic.severity != hlsl::Severity::kError) continue;
    const hlsl::ResolvedLocation place = sources.resolve(diagnostic.location);
    out.push_back({severity_of(diagnostic.severity), ErrorId{static_cast<uint16_t>(diagnostic.id)},
                   std::string(place.path), place.line, place.column, diagnostic.message,
                   hlsl::render(diagnostic, sources)});
  }
  return out;
}

// Builds the emitted code and loads it.
void build(const ShaderCompileOptions& options, const hlsl::ir::Module& module,
           ShaderCompilation& out) {
  hlsl::BuildOptions settings;
  if (options.Debug) settings.optimisation = hlsl::Optimisation::kDebug;
  if (!options.CacheDirectory.empty()) settings.cache = options.CacheDirectory;
  settings.spirv = options.Spirv;
  settings.quick = options.Quick && !options.Debug;
  settings.wide = options.WideThreads;
  const auto built = detail::build_native(options.File, options.CxxCompiler, module, settings);
  if (!built) {
    out.Status = built.error();
    return;
  }
  out.FromCache = built->from_cache;
  out.Library = built->library;
}

void interpret(const ShaderCompileOptions& options, std::shared_ptr<const hlsl::ir::Module> module,
               ShaderCompilation& out) {
  hlsl::InterpretOptions settings;
  if (options.InterpretStepLimit != 0) settings.step_limit = options.InterpretStepLimit;
  if (options.Spirv) {
    hlsl::SpirvLibrary spirv = hlsl::compile_spirv(*module);
    if (spirv.error) {
      out.Status = detail::make_compiler_error(options.File, spirv.error);
      return;
    }
    settings.spirv = std::move(spirv.modules);
  }
  const auto interpreted = hlsl::InterpretedLibrary::create(std::move(module), settings);
  if (!interpreted) {
    out.Status = detail::make_error(detail::Id::kInterpreterFailed, interpreted.error());
    return;
  }
  const auto library = detail::load_library(&(*interpreted)->desc(), (*interpreted)->coverage(),
                                            *interpreted, "interpreted library");
  if (!library) {
    out.Status = library.error();
    return;
  }
  out.Library = *library;
}

}  // namespace

ShaderPreprocessing PreprocessShader(const ShaderCompileOptions& options) {
  Loaders loaders(options);
  hlsl::SourceManager sources(loaders.chosen());
  hlsl::DiagnosticEngine diagnostics({.strict = options.Strict});
  const auto tokens = hlsl::preprocess_source(frontend_options(options), sources, diagnostics);
  ShaderPreprocessing out;
  out.Diagnostics = convert(diagnostics, sources, options.NoWarnings);
  if (!tokens || diagnostics.has_errors()) {
    out.Status = detail::make_error(detail::Id::kShaderErrors, options.File, ":\n",
                                    hlsl::render_all(diagnostics, sources));
    return out;
  }
  out.Text = hlsl::print_tokens(*tokens, sources);
  return out;
}

ShaderCompilation CompileShaderLibrary(const ShaderCompileOptions& options) {
  Loaders loaders(options);
  hlsl::SourceManager sources(loaders.chosen());
  hlsl::DiagnosticEngine diagnostics({.strict = options.Strict});
  auto module = hlsl::compile_to_ir(frontend_options(options), sources, diagnostics);

  ShaderCompilation out;
  out.Diagnostics = convert(diagnostics, sources, options.NoWarnings);
  out.Dependencies = sources.loaded_paths();
  for (const auto& [path, file] : sources.loaded_files()) {
    out.Sources.push_back({path, file->text});
  }
  if (!module || (options.WarningsAsErrors && diagnostics.warning_count() > 0)) {
    out.Status = detail::make_error(detail::Id::kShaderErrors, options.File, ":\n",
                                    hlsl::render_all(diagnostics, sources));
    return out;
  }
  out.Reflection = detail::reflect(*module);
  if (options.CheckOnly) return out;
  if (options.Interpret) {
    interpret(options, std::move(module), out);
  } else {
    build(options, *module, out);
  }
  return out;
}

}  // namespace rtapi
