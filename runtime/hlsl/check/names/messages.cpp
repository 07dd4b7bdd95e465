// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/messages.h"

#include <algorithm>
#include <string_view>

namespace kaamos::hlsl {

namespace {

// What DXC finds where a function is defined, not where it is reached, and no warnings.
bool counts_unreached(DiagnosticId id) {
  switch (id) {
    case DiagnosticId::kRecursion:
    case DiagnosticId::kCallDepth:
    case DiagnosticId::kNoBody:
    case DiagnosticId::kUnsupported:
    case DiagnosticId::kTooDeep:
    case DiagnosticId::kStage:
      return false;
    default:
      return diagnostic_info(id).severity == DiagnosticClass::kError;
  }
}

}  // namespace

void Messages::report_with_notes(DiagnosticId id, SourceLocation location,
                                 const std::vector<std::string>& arguments,
                                 const std::vector<std::pair<SourceLocation, std::string>>& notes) {
  const bool is_error = diagnostic_info(id).severity == DiagnosticClass::kError ||
                        (diagnostic_info(id).severity == DiagnosticClass::kStrict && strict_);
  if (is_unreached_ && !counts_unreached(id)) return;
  if (is_error) ++error_count_;
  if (muted_ > 0) return;
  has_errors_ = has_errors_ || is_error;
  // An expression that is lowered several times (a default argument, an initialiser) is reported
  // once.
  if (!reported_.insert({static_cast<uint32_t>(id), location.raw, arguments}).second) return;
  std::string_view views[8];
  const size_t count = std::min<size_t>(arguments.size(), 8);
  for (size_t i = 0; i < count; ++i) views[i] = arguments[i];
  auto report = [&] {
    switch (count) {
      case 0:
        return diagnostics_.report(id, location);
      case 1:
        return diagnostics_.report(id, location, {views[0]});
      case 2:
        return diagnostics_.report(id, location, {views[0], views[1]});
      case 3:
        return diagnostics_.report(id, location, {views[0], views[1], views[2]});
      case 4:
        return diagnostics_.report(id, location, {views[0], views[1], views[2], views[3]});
      default:
        return diagnostics_.report(id, location,
                                   {views[0], views[1], views[2], views[3], views[4]});
    }
  }();
  for (const auto& [note_location, text] : notes) report.note(note_location, text);
}

void Messages::report(DiagnosticId id, SourceLocation location,
                      std::initializer_list<std::string> arguments) {
  report_with_notes(id, location, std::vector<std::string>(arguments), {});
}

ir::Location Messages::locate(SourceLocation location) {
  ir::Location result;
  if (!location.is_valid()) return result;
  const ResolvedLocation resolved = sources_.resolve(location);
  result.line = resolved.line;
  result.column = resolved.column;
  const auto [entry, is_new] =
      files_.try_emplace(std::string(resolved.path), static_cast<uint32_t>(module_.files.size()));
  if (is_new) module_.files.emplace_back(resolved.path);
  result.file = entry->second;
  return result;
}

}  // namespace kaamos::hlsl
