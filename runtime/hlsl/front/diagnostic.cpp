// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/diagnostic.h"

#include <algorithm>
#include <array>

namespace kaamos::hlsl {
namespace {

constexpr DiagnosticInfo kTable[] = {
#define KAAMOS_DIAGNOSTIC(number, name, severity, text, cure) \
  {DiagnosticId::name, #name, DiagnosticClass::severity, text, cure},
#include "runtime/hlsl/front/diagnostic_ids_preprocess.inc"

#include "runtime/hlsl/front/diagnostic_ids_parse.inc"

#include "runtime/hlsl/front/diagnostic_ids_check.inc"

#include "runtime/hlsl/front/diagnostic_ids_emit.inc"
#undef KAAMOS_DIAGNOSTIC
};

constexpr bool is_ascending() {
  for (size_t i = 1; i < std::size(kTable); ++i) {
    if (kTable[i - 1].id >= kTable[i].id) return false;
  }
  return true;
}
static_assert(is_ascending(), "diagnostic numbers must ascend within and across the .inc files");

std::string fill(std::string_view text, std::initializer_list<std::string_view> arguments) {
  std::string result;
  for (size_t i = 0; i < text.size(); ++i) {
    bool is_hole = text[i] == '{' && i + 2 < text.size() && text[i + 2] == '}' &&
                   text[i + 1] >= '0' && text[i + 1] <= '9';
    if (!is_hole) {
      result += text[i];
      continue;
    }
    size_t index = static_cast<size_t>(text[i + 1] - '0');
    if (index < arguments.size()) result += arguments.begin()[index];
    i += 2;
  }
  return result;
}

}  // namespace

std::span<const DiagnosticInfo> diagnostic_table() {
  return kTable;
}

const DiagnosticInfo& diagnostic_info(DiagnosticId id) {
  return *std::lower_bound(
      std::begin(kTable), std::end(kTable), id,
      [](const DiagnosticInfo& info, DiagnosticId wanted) { return info.id < wanted; });
}

DiagnosticEngine::Report& DiagnosticEngine::Report::note(SourceLocation location,
                                                         std::string message) {
  if (diagnostic_) diagnostic_->notes.push_back({location, std::move(message)});
  return *this;
}

DiagnosticEngine::Report& DiagnosticEngine::Report::range(SourceLocation first_token,
                                                          SourceLocation last_token) {
  if (diagnostic_) {
    diagnostic_->range_begin = first_token;
    diagnostic_->range_last = last_token;
  }
  return *this;
}

DiagnosticEngine::Report DiagnosticEngine::report(
    DiagnosticId id, SourceLocation location, std::initializer_list<std::string_view> arguments) {
  if (stopped_) return Report(nullptr);
  const DiagnosticInfo& info = diagnostic_info(id);
  bool is_error = info.severity == DiagnosticClass::kError ||
                  (info.severity == DiagnosticClass::kStrict && options_.strict);
  if (is_error && options_.error_limit != 0 && errors_ == options_.error_limit) {
    stopped_ = true;
    ++errors_;
    diagnostics_.push_back({DiagnosticId::kTooManyErrors,
                            Severity::kError,
                            location,
                            {},
                            {},
                            std::string(diagnostic_info(DiagnosticId::kTooManyErrors).text),
                            {}});
    return Report(nullptr);
  }
  ++(is_error ? errors_ : warnings_);
  diagnostics_.push_back({id,
                          is_error ? Severity::kError : Severity::kWarning,
                          location,
                          {},
                          {},
                          fill(info.text, arguments),
                          {}});
  return Report(&diagnostics_.back());
}

std::string diagnostic_code(DiagnosticId id) {
  return "KA" + std::to_string(static_cast<unsigned>(id));
}

}  // namespace kaamos::hlsl
