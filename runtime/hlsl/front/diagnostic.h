// SPDX-License-Identifier: MIT
// Collects the compiler's diagnostics and renders them as text.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/hlsl/front/diagnostic_table.h"
#include "runtime/hlsl/front/source.h"

namespace kaamos::hlsl {

struct DiagnosticNote {
  SourceLocation location;
  std::string message;
};

struct Diagnostic {
  DiagnosticId id;
  Severity severity = Severity::kError;
  SourceLocation location;
  // First and last token to underline; if invalid, only the caret is shown.
  SourceLocation range_begin;
  SourceLocation range_last;
  std::string message;
  std::vector<DiagnosticNote> notes;
};

struct DiagnosticOptions {
  bool strict = false;
  uint32_t error_limit = 50;  // One kTooManyErrors follows the last one; 0: no limit.
};

class DiagnosticEngine {
 public:
  explicit DiagnosticEngine(DiagnosticOptions options = {}) : options_(options) {}

  // Fills in the text's {0}, {1}, ... from `arguments`. Notes and a range can be added to the
  // result until the next report: report(...).note(previous, "previous definition is here").
  class Report {
   public:
    explicit Report(Diagnostic* diagnostic) : diagnostic_(diagnostic) {}
    Report& note(SourceLocation location, std::string message);
    Report& range(SourceLocation first_token, SourceLocation last_token);

   private:
    Diagnostic* diagnostic_;  // nullptr: not shown, because the limit is reached.
  };
  Report report(DiagnosticId id, SourceLocation location,
                std::initializer_list<std::string_view> arguments = {});

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  uint32_t error_count() const { return errors_; }
  uint32_t warning_count() const { return warnings_; }
  bool has_errors() const { return errors_ != 0; }
  // True once the error limit is reached: a stage should end soon.
  bool should_stop() const { return stopped_; }

 private:
  DiagnosticOptions options_;
  std::vector<Diagnostic> diagnostics_;
  uint32_t errors_ = 0;
  uint32_t warnings_ = 0;
  bool stopped_ = false;
};

// "KA2002".
std::string diagnostic_code(DiagnosticId id);
// `file:line:column: error: message [KA2002]`, the source line, the caret, and the notes, with the
// chains of #include and macro expansion. Ends with a newline.
std::string render(const Diagnostic& diagnostic, const SourceManager& sources);
// Renders all of them, followed by "2 errors, 1 warning" if there are any.
std::string render_all(const DiagnosticEngine& diagnostics, const SourceManager& sources);

}  // namespace kaamos::hlsl
