// SPDX-License-Identifier: MIT
// For the tests of the lexer and preprocessor: turns files in memory into tokens and diagnostics.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/front/preprocess.h"

namespace kaamos::hlsl {

struct Preprocessed {
  explicit Preprocessed(std::string main, std::map<std::string, std::string> files = {},
                        PreprocessOptions options = {}, DiagnosticOptions diagnostic_options = {})
      : loader(std::move(files)), sources(loader), diagnostics(diagnostic_options) {
    loader.add("main.hlsl", std::move(main));
    list = preprocess_file("main.hlsl", options, sources, diagnostics);
  }

  // All tokens but the last, separated by spaces; strings are in quotes.
  std::string text() const {
    std::string result;
    for (const Token& token : list.tokens) {
      if (token.is(TokenKind::kEndOfFile)) break;
      if (!result.empty()) result += ' ';
      bool is_string = token.is(TokenKind::kStringLiteral);
      if (token.is(TokenKind::kPragmaPackMatrix)) result += "pack:";
      if (is_string) result += '"';
      result += token.text;
      if (is_string) result += '"';
    }
    return result;
  }

  // "main.hlsl:2:5 KA2002" for each diagnostic, in order.
  std::vector<std::string> places() const {
    std::vector<std::string> result;
    for (const Diagnostic& diagnostic : diagnostics.diagnostics()) {
      ResolvedLocation at = sources.resolve(diagnostic.location);
      result.push_back(std::string(at.path) + ":" + std::to_string(at.line) + ":" +
                       std::to_string(at.column) + " " + diagnostic_code(diagnostic.id));
    }
    return result;
  }

  std::string rendered() const { return render_all(diagnostics, sources); }

  MemoryFileLoader loader;
  SourceManager sources;
  DiagnosticEngine diagnostics;
  TokenList list;
};

}  // namespace kaamos::hlsl
