// SPDX-License-Identifier: MIT
// Keeps track of where text comes from: files, the chain of #include, the chain of macro
// expansions. A location is 32 bits; the SourceManager turns it into file, line and column.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace kaamos::hlsl {

class FileLoader;

// A position in a file, or a token that a macro expansion produced. 0: no location.
struct SourceLocation {
  uint32_t raw = 0;

  static constexpr uint32_t kMacroBit = 0x80000000u;

  constexpr bool is_valid() const { return raw != 0; }
  constexpr bool is_macro() const { return (raw & kMacroBit) != 0; }
  // `bytes` further on in the same file; a token from a macro expansion does not move.
  constexpr SourceLocation advanced(uint32_t bytes) const {
    return is_macro() || raw == 0 ? *this : SourceLocation{raw + bytes};
  }
  friend constexpr bool operator==(SourceLocation, SourceLocation) = default;
};

// A location as a person reads it: the outermost place in a file, with #line applied.
struct ResolvedLocation {
  std::string_view path;  // Empty if there is no location.
  uint32_t line = 0;      // Counted from 1.
  uint32_t column = 0;    // Counted from 1, in bytes.
};

// The text of one file; shared by all inclusions of it.
struct SourceText {
  std::string path;       // As found; what diagnostics show.
  std::string canonical;  // Names the file uniquely.
  std::string text;       // std::string ends in a zero byte, which is the lexer's sentinel.
  std::vector<uint32_t> line_starts;  // Filled when a line is first looked up.
};

class SourceManager {
 public:
  // The way of one token through a macro: `spelling` is the token in the #define, `invocation` the
  // macro's name where it was used (itself a macro location if macros are nested).
  struct MacroExpansion {
    std::string_view macro;
    SourceLocation spelling;
    SourceLocation invocation;
  };

  // An inclusion of a text; the same text may be included many times.
  using FileIndex = uint32_t;

  explicit SourceManager(FileLoader& loader) : loader_(loader) {}
  SourceManager(const SourceManager&) = delete;
  SourceManager& operator=(const SourceManager&) = delete;

  // The file's text, cached after the first time; nullptr if there is none. `error` is set only if
  // the file exists but cannot be read.
  SourceText* load(const std::string& path, std::string* error);
  // Other files may have the same paths from here on; what was read stays.
  void forget_paths();
  // A text that does not come from a loader, such as -D options.
  SourceText* add_text(std::string name, std::string text);
  // Enters a text at `included_from` (invalid for the main file). Returns nullopt if the 2 GiB of
  // locations are used up.
  std::optional<FileIndex> add_file(SourceText* text, SourceLocation included_from);

  const SourceText& text_of(FileIndex file) const { return *files_[file].text; }
  SourceLocation location(FileIndex file, uint32_t offset) const {
    return {files_[file].base + offset};
  }
  // From the line after `offset`, lines count from `line` [C++: line control].
  void set_line(FileIndex file, uint32_t offset, uint32_t line, std::optional<std::string> name);

  // Registers an expansion of `macro` (whose text lives as long as this object).
  uint32_t begin_expansion(std::string_view macro, SourceLocation invocation);
  SourceLocation expansion_token(uint32_t expansion, SourceLocation spelling);

  // The outermost place in a file: where the macro was used, or the location itself.
  SourceLocation file_location(SourceLocation location) const;
  // The place of the characters: in the #define for a token of a macro's body.
  SourceLocation spelling_location(SourceLocation location) const;
  std::optional<MacroExpansion> expansion_of(SourceLocation location) const;
  // The #include that included the file of this location; invalid for the main file.
  SourceLocation include_location(SourceLocation location) const;
  ResolvedLocation resolve(SourceLocation location) const;
  // The whole line without its newline; empty if there is no location.
  std::string_view line_text(SourceLocation location) const;

  // Keeps a text as long as this object lives, followed by a zero byte.
  std::string_view keep(std::string text);
  // Paths of all files that were read, in the order in which they were read.
  std::vector<std::string> loaded_paths() const;
  // The same with their texts, by the path that was asked for, sorted by that path.
  std::vector<std::pair<std::string, const SourceText*>> loaded_files() const;

 private:
  struct LineOverride {
    uint32_t offset;
    uint32_t physical_line;
    uint32_t line;
    std::string_view name;
  };
  struct File {
    uint32_t base;
    SourceText* text;
    SourceLocation included_from;
    std::vector<LineOverride> overrides;
  };
  struct Expansion {
    std::string_view macro;
    SourceLocation invocation;
  };
  struct ExpansionToken {
    uint32_t expansion;
    SourceLocation spelling;
  };

  const File* file_at(SourceLocation location) const;
  static uint32_t physical_line(SourceText& text, uint32_t offset);

  FileLoader& loader_;
  std::unordered_map<std::string, SourceText*> by_path_;       // As asked for; null: no such file.
  std::unordered_map<std::string, SourceText*> by_canonical_;  // By the path found.
  std::vector<std::unique_ptr<SourceText>> texts_;
  std::vector<File> files_;
  std::vector<Expansion> expansions_;
  std::vector<ExpansionToken> expansion_tokens_;
  std::deque<std::string> kept_;
  uint32_t next_base_ = 1;
};

}  // namespace kaamos::hlsl
