// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/source.h"

#include <algorithm>

#include "runtime/hlsl/front/file_loader.h"

namespace kaamos::hlsl {

SourceText* SourceManager::load(const std::string& path, std::string* error) {
  if (auto known = by_path_.find(path); known != by_path_.end()) return known->second;
  std::string failure;
  std::optional<LoadedFile> loaded = loader_.load(path, &failure);
  if (!loaded) {
    if (error) *error = failure;
    // A file that exists but cannot be read is tried again each time, so that each use reports why.
    if (failure.empty()) by_path_[path] = nullptr;
    return nullptr;
  }
  SourceText*& text = by_canonical_[loaded->canonical];
  if (!text) {
    text = add_text(std::move(loaded->path), std::move(loaded->text));
    text->canonical = std::move(loaded->canonical);
  }
  by_path_[path] = text;
  return text;
}

void SourceManager::forget_paths() {
  by_path_.clear();
  by_canonical_.clear();
}

SourceText* SourceManager::add_text(std::string name, std::string text) {
  auto owned = std::make_unique<SourceText>();
  owned->path = std::move(name);
  owned->text = std::move(text);
  texts_.push_back(std::move(owned));
  return texts_.back().get();
}

std::optional<SourceManager::FileIndex> SourceManager::add_file(SourceText* text,
                                                                SourceLocation included_from) {
  // One more than the size, because the end of the file is a location too.
  uint64_t end = uint64_t{next_base_} + text->text.size() + 1;
  if (end >= SourceLocation::kMacroBit) return std::nullopt;
  files_.push_back({next_base_, text, included_from, {}});
  next_base_ = static_cast<uint32_t>(end);
  return static_cast<FileIndex>(files_.size() - 1);
}

void SourceManager::set_line(FileIndex file, uint32_t offset, uint32_t line,
                             std::optional<std::string> name) {
  File& entry = files_[file];
  std::string_view shown =
      entry.overrides.empty() ? std::string_view(entry.text->path) : entry.overrides.back().name;
  if (name) shown = keep(std::move(*name));
  entry.overrides.push_back({offset, physical_line(*entry.text, offset), line, shown});
}

uint32_t SourceManager::begin_expansion(std::string_view macro, SourceLocation invocation) {
  expansions_.push_back({macro, invocation});
  return static_cast<uint32_t>(expansions_.size() - 1);
}

SourceLocation SourceManager::expansion_token(uint32_t expansion, SourceLocation spelling) {
  expansion_tokens_.push_back({expansion, spelling});
  return {SourceLocation::kMacroBit | static_cast<uint32_t>(expansion_tokens_.size() - 1)};
}

SourceLocation SourceManager::file_location(SourceLocation location) const {
  while (location.is_macro()) {
    const ExpansionToken& token = expansion_tokens_[location.raw & ~SourceLocation::kMacroBit];
    location = expansions_[token.expansion].invocation;
  }
  return location;
}

SourceLocation SourceManager::spelling_location(SourceLocation location) const {
  while (location.is_macro()) {
    location = expansion_tokens_[location.raw & ~SourceLocation::kMacroBit].spelling;
  }
  return location;
}

std::optional<SourceManager::MacroExpansion> SourceManager::expansion_of(
    SourceLocation location) const {
  if (!location.is_macro()) return std::nullopt;
  const ExpansionToken& token = expansion_tokens_[location.raw & ~SourceLocation::kMacroBit];
  const Expansion& expansion = expansions_[token.expansion];
  return MacroExpansion{expansion.macro, token.spelling, expansion.invocation};
}

const SourceManager::File* SourceManager::file_at(SourceLocation location) const {
  if (!location.is_valid() || files_.empty()) return nullptr;
  auto behind = std::upper_bound(files_.begin(), files_.end(), location.raw,
                                 [](uint32_t raw, const File& file) { return raw < file.base; });
  if (behind == files_.begin()) return nullptr;
  return &*std::prev(behind);
}

SourceLocation SourceManager::include_location(SourceLocation location) const {
  const File* file = file_at(file_location(location));
  return file ? file->included_from : SourceLocation{};
}

uint32_t SourceManager::physical_line(SourceText& text, uint32_t offset) {
  std::vector<uint32_t>& starts = text.line_starts;
  if (starts.empty()) {
    starts.push_back(0);
    const std::string& bytes = text.text;
    for (uint32_t i = 0; i < bytes.size(); ++i) {
      bool is_lone_return = bytes[i] == '\r' && (i + 1 == bytes.size() || bytes[i + 1] != '\n');
      if (bytes[i] == '\n' || is_lone_return) starts.push_back(i + 1);
    }
  }
  auto behind = std::upper_bound(starts.begin(), starts.end(), offset);
  return static_cast<uint32_t>(behind - starts.begin());
}

ResolvedLocation SourceManager::resolve(SourceLocation location) const {
  location = file_location(location);
  const File* file = file_at(location);
  if (!file) return {};
  uint32_t offset = location.raw - file->base;
  uint32_t line = physical_line(*file->text, offset);
  uint32_t line_start = file->text->line_starts[line - 1];
  // A byte order mark does not count as a column.
  uint32_t mark = line == 1 && file->text->text.starts_with("\xEF\xBB\xBF") && offset >= 3 ? 3 : 0;
  ResolvedLocation result{file->text->path, line, offset - line_start - mark + 1};
  for (auto it = file->overrides.rbegin(); it != file->overrides.rend(); ++it) {
    if (it->offset > offset || line <= it->physical_line) continue;
    result.path = it->name;
    result.line = it->line + (line - it->physical_line - 1);
    break;
  }
  return result;
}

std::string_view SourceManager::line_text(SourceLocation location) const {
  location = file_location(location);
  const File* file = file_at(location);
  if (!file) return {};
  uint32_t line = physical_line(*file->text, location.raw - file->base);
  std::string_view rest =
      std::string_view(file->text->text).substr(file->text->line_starts[line - 1]);
  if (line == 1 && rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  return rest.substr(0, rest.find_first_of("\r\n"));
}

std::string_view SourceManager::keep(std::string text) {
  kept_.push_back(std::move(text));
  return kept_.back();
}

std::vector<std::string> SourceManager::loaded_paths() const {
  std::vector<std::string> paths;
  for (const auto& text : texts_) {
    if (!text->canonical.empty()) paths.push_back(text->path);
  }
  return paths;
}

std::vector<std::pair<std::string, const SourceText*>> SourceManager::loaded_files() const {
  std::vector<std::pair<std::string, const SourceText*>> files;
  for (const auto& [path, text] : by_path_) {
    if (text != nullptr) files.emplace_back(path, text);
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace kaamos::hlsl
