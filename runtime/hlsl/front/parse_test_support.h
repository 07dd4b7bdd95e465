// SPDX-License-Identifier: MIT
// Shared by the parser's tests: parses a text and gives the tree and the diagnostics.
#pragma once

#include <string>
#include <string_view>

#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/front/parse.h"
#include "runtime/hlsl/front/preprocess.h"
#include "runtime/hlsl/front/testing/ast_dump.h"

namespace kaamos::hlsl::test {

struct Parsed {
  MemoryFileLoader loader;
  SourceManager sources{loader};
  DiagnosticEngine diagnostics;
  AstArena arena;
  TokenList tokens;
  const TranslationUnit* unit = nullptr;

  explicit Parsed(std::string text) {
    tokens = preprocess_text("test.hlsl", std::move(text), {}, sources, diagnostics);
    unit = parse(tokens, arena, diagnostics);
  }
  // Empty if there are no diagnostics.
  std::string messages() const {
    return diagnostics.diagnostics().empty() ? "" : render_all(diagnostics, sources);
  }
};

// The dump of a whole text, or the diagnostics if there are any.
inline std::string dump_unit(std::string_view text) {
  const Parsed parsed{std::string(text)};
  const std::string messages = parsed.messages();
  return messages.empty() ? dump(*parsed.unit) : messages;
}

// The dump of an expression; `before` holds the declarations it needs.
inline std::string dump_expression(std::string_view text, std::string_view before = "") {
  const Parsed parsed(std::string(before) + "\nstatic float test_value = " + std::string(text) +
                      ";");
  const std::string messages = parsed.messages();
  if (!messages.empty()) return messages;
  const auto* variable = as<VariableDecl>(parsed.unit->declarations.back());
  return variable != nullptr && variable->initializer != nullptr ? dump(*variable->initializer)
                                                                 : "no expression";
}

// The dump of the statements in a function body.
inline std::string dump_statements(std::string_view text, std::string_view before = "") {
  const Parsed parsed(std::string(before) + "\nvoid test_function() { " + std::string(text) + " }");
  const std::string messages = parsed.messages();
  if (!messages.empty()) return messages;
  const auto* function = as<FunctionDecl>(parsed.unit->declarations.back());
  if (function == nullptr || function->body == nullptr) return "no function";
  std::string result;
  for (const Stmt* statement : function->body->statements) result += dump(*statement);
  return result;
}

// "KA2201 3:4" for each diagnostic, one per line.
inline std::string positions(const Parsed& parsed) {
  std::string result;
  for (const Diagnostic& diagnostic : parsed.diagnostics.diagnostics()) {
    const ResolvedLocation place = parsed.sources.resolve(diagnostic.location);
    if (!result.empty()) result += '\n';
    result += diagnostic_code(diagnostic.id) + " " + std::to_string(place.line) + ":" +
              std::to_string(place.column);
  }
  return result;
}

}  // namespace kaamos::hlsl::test
