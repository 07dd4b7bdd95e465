// SPDX-License-Identifier: MIT
#include <algorithm>

#include "runtime/hlsl/front/diagnostic.h"

namespace kaamos::hlsl {
namespace {

constexpr size_t kTabColumns = 4;
constexpr size_t kMaxLineColumns = 160;  // Longer lines are cut to the part around the caret.
constexpr size_t kMaxMacroNotes = 8;
constexpr size_t kMaxIncludeNotes = 8;

// One source line as shown: tabs become spaces, other control bytes '?'.
struct ShownLine {
  std::string text;
  std::vector<size_t> column_of_byte;  // The screen column where each source byte begins.
};

bool is_continuation_byte(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

ShownLine show(std::string_view line) {
  ShownLine shown;
  size_t column = 0;
  for (char c : line) {
    if (is_continuation_byte(c)) {
      shown.column_of_byte.push_back(column == 0 ? 0 : column - 1);
      shown.text += c;
      continue;
    }
    shown.column_of_byte.push_back(column);
    if (c == '\t') {
      size_t width = kTabColumns - column % kTabColumns;
      shown.text.append(width, ' ');
      column += width;
    } else {
      shown.text += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
      ++column;
    }
  }
  shown.column_of_byte.push_back(column);
  return shown;
}

// The length of the token that begins at `begin`: a word, number or string, otherwise one
// character.
size_t token_bytes(std::string_view line, size_t begin) {
  auto is_word = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  if (begin >= line.size()) return 0;
  size_t end = begin + 1;
  if (line[begin] == '"') {
    while (end < line.size() && line[end] != '"') ++end;
    return std::min(end + 1, line.size()) - begin;
  }
  if (is_word(line[begin])) {
    while (end < line.size() && is_word(line[end])) ++end;
  }
  return end - begin;
}

// Cuts a long line down to the part around the caret.
void cut(std::string& text, std::string& marks, size_t caret) {
  if (text.size() <= kMaxLineColumns) return;
  size_t begin = caret > kMaxLineColumns / 2 ? caret - kMaxLineColumns / 2 : 0;
  while (begin > 0 && begin < text.size() && is_continuation_byte(text[begin])) --begin;
  size_t count = kMaxLineColumns;
  while (begin + count < text.size() && is_continuation_byte(text[begin + count])) ++count;
  bool is_cut_behind = begin + count < text.size();
  text = (begin ? "..." : "") + (begin < text.size() ? text.substr(begin, count) : "") +
         (is_cut_behind ? "..." : "");
  marks = (begin ? "   " : "") + (begin < marks.size() ? marks.substr(begin, count) : "");
}

// `location` and the range must be in one file; only what is on the caret's line is marked.
std::string snippet(const SourceManager& sources, SourceLocation location, SourceLocation first,
                    SourceLocation last) {
  std::string_view line = sources.line_text(location);
  ResolvedLocation at = sources.resolve(location);
  ShownLine shown = show(line);
  size_t caret_byte = std::min<size_t>(at.column - 1, line.size());
  size_t begin = caret_byte;
  size_t end = caret_byte + 1;
  if (first.is_valid() && last.is_valid()) {
    ResolvedLocation from = sources.resolve(first);
    ResolvedLocation to = sources.resolve(last);
    if (from.path == at.path && from.line == at.line)
      begin = std::min<size_t>(from.column - 1, caret_byte);
    if (from.path == at.path && from.line < at.line) begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos || begin > caret_byte) begin = caret_byte;
    if (to.path == at.path && to.line == at.line && to.column - 1 < line.size()) {
      end = std::max(end, to.column - 1 + token_bytes(line, to.column - 1));
    }
    if (to.path == at.path && to.line > at.line) end = line.size();
  }
  end = std::clamp(end, caret_byte, line.size());
  size_t mark_begin = shown.column_of_byte[begin];
  size_t mark_end = shown.column_of_byte[end];
  size_t caret = shown.column_of_byte[caret_byte];
  std::string marks(std::max(mark_end, caret + 1), ' ');
  std::fill(marks.begin() + static_cast<ptrdiff_t>(mark_begin),
            marks.begin() + static_cast<ptrdiff_t>(std::max(mark_end, mark_begin)), '~');
  marks[caret] = '^';
  cut(shown.text, marks, caret);
  return shown.text + "\n" + marks + "\n";
}

std::string place(const ResolvedLocation& at) {
  return std::string(at.path) + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
}

// From the main file down to the location's file; a long chain shows only the inner end.
std::string include_chain(const SourceManager& sources, SourceLocation location) {
  std::string result;
  SourceLocation from = sources.include_location(location);
  for (size_t i = 0; from.is_valid() && i < kMaxIncludeNotes; ++i) {
    ResolvedLocation at = sources.resolve(from);
    result.insert(
        0, "In file included from " + std::string(at.path) + ":" + std::to_string(at.line) + ":\n");
    from = sources.include_location(from);
  }
  if (from.is_valid()) result.insert(0, "(more #include above)\n");
  return result;
}

std::string entry(const SourceManager& sources, std::string_view severity, std::string_view message,
                  SourceLocation location, SourceLocation first, SourceLocation last) {
  std::string text(severity);
  text += ": ";
  text += message;
  text += '\n';
  if (!location.is_valid()) return text;
  return place(sources.resolve(location)) + ": " + text + snippet(sources, location, first, last);
}

// From the outermost macro to the innermost.
std::string macro_notes(const SourceManager& sources, SourceLocation location) {
  std::vector<SourceManager::MacroExpansion> chain;
  while (auto expansion = sources.expansion_of(location)) {
    chain.push_back(*expansion);
    location = expansion->invocation;
  }
  std::string result;
  size_t left_out = chain.size() > kMaxMacroNotes ? chain.size() - kMaxMacroNotes : 0;
  for (size_t i = chain.size() - left_out; i-- > 0;) {
    SourceLocation spelling = sources.spelling_location(chain[i].spelling);
    result += entry(sources, "note", "expanded from macro '" + std::string(chain[i].macro) + "'",
                    spelling, {}, {});
  }
  if (left_out) {
    result += "note: " + std::to_string(left_out) + " more macro expansions are not shown\n";
  }
  return result;
}

}  // namespace

std::string render(const Diagnostic& diagnostic, const SourceManager& sources) {
  std::string_view severity = diagnostic.severity == Severity::kError ? "error" : "warning";
  std::string result = include_chain(sources, diagnostic.location);
  result +=
      entry(sources, severity, diagnostic.message + " [" + diagnostic_code(diagnostic.id) + "]",
            diagnostic.location, diagnostic.range_begin, diagnostic.range_last);
  result += macro_notes(sources, diagnostic.location);
  for (const DiagnosticNote& note : diagnostic.notes) {
    result += entry(sources, "note", note.message, note.location, {}, {});
    result += macro_notes(sources, note.location);
  }
  return result;
}

std::string render_all(const DiagnosticEngine& diagnostics, const SourceManager& sources) {
  std::string result;
  for (const Diagnostic& diagnostic : diagnostics.diagnostics()) {
    result += render(diagnostic, sources);
  }
  auto count = [](uint32_t number, std::string_view word) {
    return std::to_string(number) + " " + std::string(word) + (number == 1 ? "" : "s");
  };
  if (diagnostics.error_count()) result += count(diagnostics.error_count(), "error");
  if (diagnostics.error_count() && diagnostics.warning_count()) result += ", ";
  if (diagnostics.warning_count()) result += count(diagnostics.warning_count(), "warning");
  if (!result.empty()) result += "\n";
  return result;
}

}  // namespace kaamos::hlsl
