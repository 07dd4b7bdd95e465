// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/frontend.h"

#include <string_view>
#include <utility>

#include "runtime/hlsl/driver/embedded_source.h"
#include "runtime/hlsl/front/parse.h"
#include "runtime/hlsl/front/preprocess.h"

namespace kaamos::hlsl {
namespace {

std::vector<std::string> split_at(const std::string& text, char separator) {
  std::vector<std::string> parts;
  size_t start = 0;
  for (size_t end = text.find(separator); end != std::string::npos;
       end = text.find(separator, start)) {
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  parts.push_back(text.substr(start));
  return parts;
}

// Splits lib_6_3 into "lib" and "3"; "" and "" if it is not a profile of model 6 of an offered
// stage.
std::pair<std::string_view, std::string_view> stage_and_minor(std::string_view target) {
  for (const std::string_view stage : {"lib", "cs", "vs", "gs", "ps"}) {
    if (!target.starts_with(stage) || !target.substr(stage.size()).starts_with("_6_")) continue;
    return {stage, target.substr(stage.size() + 3)};
  }
  return {};
}

// For lib_6_3, cs_6_6, vs_6_0, gs_6_0 or ps_6_0, the number after "6_", where x counts as 8; -1 for
// any other profile.
int minor_version(const std::string& target) {
  const auto [stage, minor] = stage_and_minor(target);
  if (minor == "10") return 10;
  if (minor.size() != 1) return -1;
  const char digit = minor[0];
  const bool library = stage == "lib";
  if (digit == 'x') return library ? 8 : -1;
  if (digit < (library ? '3' : '0') || digit > '9') return -1;
  return digit - '0';
}

}  // namespace

std::optional<std::vector<ExportRequest>> parse_exports(const std::string& text) {
  std::vector<ExportRequest> requests;
  if (text.empty()) return requests;
  for (const std::string& part : split_at(text, ';')) {
    if (part.empty()) continue;
    const size_t equals = part.find('=');
    ExportRequest request;
    request.function = equals == std::string::npos ? part : part.substr(equals + 1);
    request.names = split_at(part.substr(0, equals), ',');
    for (const std::string& name : request.names) {
      if (name.empty()) return std::nullopt;
    }
    if (request.function.empty()) return std::nullopt;
    requests.push_back(std::move(request));
  }
  return requests;
}

std::optional<TokenList> preprocess_source(const FrontendOptions& options, SourceManager& sources,
                                           DiagnosticEngine& diagnostics) {
  const int minor = minor_version(options.target);
  const bool is_experimental = minor > 9;
  if (minor < 0 || (is_experimental && !options.experimental)) {
    diagnostics.report(
        is_experimental ? DiagnosticId::kExperimentalTarget : DiagnosticId::kUnknownTarget, {},
        {options.target});
    return std::nullopt;
  }
  PreprocessOptions preprocess;
  preprocess.include_folders = options.include_folders;
  preprocess.defines = options.defines;
  preprocess.stage = options.target.starts_with("lib")  ? ShaderStage::kLibrary
                     : options.target.starts_with("vs") ? ShaderStage::kVertex
                     : options.target.starts_with("gs") ? ShaderStage::kGeometry
                     : options.target.starts_with("ps") ? ShaderStage::kPixel
                                                        : ShaderStage::kCompute;
  preprocess.shader_model_minor = static_cast<uint32_t>(minor);
  preprocess.hlsl_version = options.hlsl_version;
  preprocess.enable_16bit_types = options.native_16bit;
  return options.text
             ? preprocess_text(options.path, *options.text, preprocess, sources, diagnostics)
             : preprocess_file(options.path, preprocess, sources, diagnostics);
}

std::unique_ptr<ParsedSource> parse_source(const FrontendOptions& options, SourceManager& sources,
                                           DiagnosticEngine& diagnostics) {
  const int minor = minor_version(options.target);
  const auto exports = parse_exports(options.exports);
  if (minor >= 0 && !exports) {
    diagnostics.report(DiagnosticId::kExportSyntax, {}, {options.exports});
    return nullptr;
  }
  if (minor >= 0 && options.payload_qualifiers.value_or(false) && minor < 6) {
    diagnostics.report(DiagnosticId::kPayloadTarget, {}, {options.target});
    return nullptr;
  }
  auto tokens = preprocess_source(options, sources, diagnostics);
  if (!tokens) return nullptr;
  auto parsed = std::make_unique<ParsedSource>();
  parsed->tokens = *std::move(tokens);
  // What the missing file declares would only be reported as undeclared.
  for (const Diagnostic& diagnostic : diagnostics.diagnostics()) {
    const bool is_missing = diagnostic.id == DiagnosticId::kIncludeNotFound ||
                            diagnostic.id == DiagnosticId::kIncludeUnreadable;
    if (is_missing && diagnostic.severity == Severity::kError) return nullptr;
  }
  parsed->tree = parse(parsed->tokens, parsed->arena, diagnostics);
  CheckOptions& check_options = parsed->options;
  check_options.name = options.path;
  check_options.target = options.target;
  check_options.entry_point = options.entry_point;
  check_options.exports = *exports;
  check_options.external_linkage = options.external_linkage;
  check_options.automatic_space = options.automatic_space;
  check_options.reserve_unused = options.reserve_unused;
  check_options.native_16bit = options.native_16bit;
  check_options.row_major = options.row_major;
  check_options.hlsl_version = options.hlsl_version;
  check_options.payload_qualifiers = options.payload_qualifiers.value_or(minor >= 7);
  check_options.strict = options.strict;
  check_options.coverage = options.coverage;
  return parsed;
}

std::unique_ptr<ir::Module> compile_to_ir(const FrontendOptions& options, SourceManager& sources,
                                          DiagnosticEngine& diagnostics) {
  const auto parsed = parse_source(options, sources, diagnostics);
  if (parsed == nullptr) return nullptr;
  auto module = check(*parsed->tree, parsed->options, sources, diagnostics);
  if (module != nullptr) {
    module->check_access = options.check_access;
    if (options.embed_source) module->source = embed_source(options, sources);
  }
  return module;
}

}  // namespace kaamos::hlsl
