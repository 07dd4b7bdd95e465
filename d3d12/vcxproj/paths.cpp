// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/paths.h"

#include <algorithm>
#include <system_error>

#include "d3d12/vcxproj/text.h"

namespace kaamos::vcxproj {
namespace {

namespace fs = std::filesystem;

// Whether a name matches a pattern of * and ?; with `path`, * stays within a folder and ** does
// not.
bool matches(std::string_view name, std::string_view pattern) {
  if (pattern.empty()) return name.empty();
  if (pattern.starts_with("**/")) {
    if (matches(name, pattern.substr(3))) return true;
    const size_t slash = name.find('/');
    return slash != std::string_view::npos && matches(name.substr(slash + 1), pattern);
  }
  if (pattern.starts_with("**")) return true;
  if (pattern.front() == '*') {
    for (size_t i = 0; i <= name.size(); ++i) {
      if (matches(name.substr(i), pattern.substr(1))) return true;
      if (i < name.size() && name[i] == '/') break;
    }
    return false;
  }
  if (name.empty()) return false;
  if (pattern.front() != '?' && pattern.front() != name.front()) return false;
  return matches(name.substr(1), pattern.substr(1));
}

std::optional<fs::path> find_entry(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  std::optional<fs::path> found;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (same(it->path().filename().string(), name) && (!found || it->path() < *found)) {
      found = it->path();
    }
  }
  return found;
}

}  // namespace

std::string slashes(std::string_view path) {
  std::string out;
  for (const char c : trim(path)) {
    if (c == '"') continue;
    out += c == '\\' ? '/' : c;
  }
  return trim(out);
}

fs::path absolute_path(const fs::path& folder, std::string_view path) {
  fs::path out = (folder / slashes(path)).lexically_normal();
  if (!out.has_filename() && out.has_relative_path()) out = out.parent_path();
  return out;
}

std::optional<fs::path> find_path(const fs::path& folder, std::string_view path) {
  const fs::path wanted = absolute_path(folder, path);
  std::error_code error;
  if (fs::exists(wanted, error)) return wanted;
  fs::path found = wanted.root_path();
  for (const fs::path& part : wanted.relative_path()) {
    const std::optional<fs::path> next = find_entry(found, part.string());
    if (!next) return std::nullopt;
    found = *next;
  }
  return found;
}

bool has_wildcard(std::string_view path) {
  return path.find_first_of("*?") != std::string_view::npos;
}

std::vector<fs::path> find_wildcard(const fs::path& folder, std::string_view path) {
  const std::string text = slashes(path);
  const size_t slash = text.rfind('/', text.find_first_of("*?"));
  const std::string start = slash == std::string::npos ? "." : text.substr(0, slash + 1);
  const std::string pattern = lower(slash == std::string::npos ? text : text.substr(slash + 1));
  const std::optional<fs::path> root = find_path(folder, start);
  std::vector<fs::path> files;
  if (!root) return files;
  const bool deep = pattern.find('/') != std::string::npos || pattern.starts_with("**");
  std::error_code error;
  for (fs::recursive_directory_iterator it(*root, error), end; !error && it != end;
       it.increment(error)) {
    if (it->is_directory(error)) {
      if (!deep) it.disable_recursion_pending();
    } else if (matches(lower(it->path().lexically_relative(*root).generic_string()), pattern)) {
      files.push_back(it->path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<std::string> path_below(const fs::path& folder, const fs::path& path) {
  auto at = path.begin();
  for (const fs::path& part : folder) {
    if (part.empty()) continue;
    if (at == path.end() || !same(part.string(), at->string())) return std::nullopt;
    ++at;
  }
  fs::path rest;
  for (; at != path.end(); ++at) rest /= *at;
  return rest.empty() ? "." : rest.generic_string();
}

}  // namespace kaamos::vcxproj
