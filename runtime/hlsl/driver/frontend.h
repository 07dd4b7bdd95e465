// SPDX-License-Identifier: MIT
//
// From HLSL source to the intermediate representation: preprocess, parse, check.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/hlsl/check/check.h"
#include "runtime/hlsl/front/ast_arena.h"
#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/front/source.h"
#include "runtime/hlsl/front/token.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

struct FrontendOptions {
  std::string path;                 // path of the main file; with `text`, its name in messages
  std::optional<std::string> text;  // the source itself; if empty, the file is read
  std::vector<std::string> include_folders;
  std::vector<std::string> defines;  // "NAME" or "NAME=VALUE"
  std::string target = "lib_6_6";    // lib_6_3 .. lib_6_10, lib_6_x, cs_6_0 .. cs_6_10
  std::string entry_point = "main";  // cs_6_x only [-E]
  std::string exports;               // as DXC's -exports: "A;B1,B2=C"
  bool external_linkage = false;     // [-default-linkage external]; lib_6_x always has it
  uint32_t automatic_space = 0;      // [-auto-binding-space]
  uint32_t hlsl_version = 2021;      // [-HV]
  bool reserve_unused = false;       // [-flegacy-resource-reservation]
  bool native_16bit = false;         // [-enable-16bit-types]
  bool experimental = false;         // profiles of 6.10 [-enable-experimental]
  bool row_major = false;            // [-Zpr]; false is [-Zpc]
  // -enable-payload-qualifiers, -disable-payload-qualifiers; if empty, on from lib_6_7 up.
  std::optional<bool> payload_qualifiers = {};
  bool check_access = false;  // Module::check_access
  bool coverage = false;      // CheckOptions::coverage; not part of Module::source
  bool embed_source = true;   // Module::source
  bool strict = false;        // refuse what DXC refuses; the diagnostic engine needs it too
};

// Returns null after an error, which is then in `diagnostics`. `sources` must outlive the rendering
// of the diagnostics, and lists the files that were read.
std::unique_ptr<ir::Module> compile_to_ir(const FrontendOptions& options, SourceManager& sources,
                                          DiagnosticEngine& diagnostics);

// Empty if a profile is unknown; errors of the source are in `diagnostics` only.
std::optional<TokenList> preprocess_source(const FrontendOptions& options, SourceManager& sources,
                                           DiagnosticEngine& diagnostics);

// A source up to its syntax tree, and how it is to be checked.
struct ParsedSource {
  TokenList tokens;
  AstArena arena;
  const TranslationUnit* tree = nullptr;
  CheckOptions options;
};
// Returns null if it cannot even be parsed; other errors are in `diagnostics` only.
std::unique_ptr<ParsedSource> parse_source(const FrontendOptions& options, SourceManager& sources,
                                           DiagnosticEngine& diagnostics);

// Parses "A;B1,B2=C" into requests. Empty if `text` does not have that form.
std::optional<std::vector<ExportRequest>> parse_exports(const std::string& text);

}  // namespace kaamos::hlsl
