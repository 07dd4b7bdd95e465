// SPDX-License-Identifier: MIT
// Tests of mistakes: an `@` in the text marks the token that the message must point at.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "runtime/hlsl/check/check_test_support.h"

namespace kaamos::hlsl {

struct Marked {
  std::string text;
  uint32_t line = 0;  // 0: no mark
  uint32_t column = 0;
};

inline Marked strip_mark(const std::string& text) {
  Marked result{text, 0, 0};
  const size_t at = text.find('@');
  if (at == std::string::npos) return result;
  result.text.erase(at, 1);
  result.line = 1;
  result.column = 1;
  for (size_t i = 0; i < at; ++i) {
    if (text[i] == '\n') {
      ++result.line;
      result.column = 1;
    } else {
      ++result.column;
    }
  }
  return result;
}

// The first error is `id`, at the mark; or there is no error, and `id` is a warning at the mark.
inline void expect_at_mark(DiagnosticId id, const std::string& text,
                           const FrontendOptions& options = {}) {
  const Marked marked = strip_mark(text);
  const Compilation compilation(marked.text, options);
  const Severity wanted = diagnostic_info(id).severity == DiagnosticClass::kError || options.strict
                              ? Severity::kError
                              : Severity::kWarning;
  EXPECT_EQ(compilation.module == nullptr, wanted == Severity::kError);
  for (const Diagnostic& diagnostic : compilation.diagnostics()) {
    if (diagnostic.severity == Severity::kError && diagnostic.id != id) break;
    if (diagnostic.id != id) continue;
    EXPECT_EQ(diagnostic.severity, wanted);
    if (marked.line == 0) return;
    const ResolvedLocation at = compilation.resolve(diagnostic.location);
    EXPECT_EQ(at.line, marked.line) << compilation.messages();
    EXPECT_EQ(at.column, marked.column) << compilation.messages();
    return;
  }
  ADD_FAILURE() << "not reported first: " << diagnostic_info(id).name << "\n"
                << compilation.messages();
}

}  // namespace kaamos::hlsl
