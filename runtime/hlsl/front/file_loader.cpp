// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/file_loader.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool equal_without_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

// The entry of `folder` that equals `name` except for case. If there are several, the
// alphabetically first, so that the result does not depend on the file system.
std::optional<fs::path> find_without_case(const fs::path& folder, const std::string& name) {
  std::error_code failure;
  std::optional<fs::path> best;
  fs::directory_iterator it(folder.empty() ? fs::path(".") : folder, failure);
  for (; !failure && it != fs::directory_iterator(); it.increment(failure)) {
    fs::path entry = it->path().filename();
    if (equal_without_case(entry.string(), name) && (!best || entry < *best)) best = entry;
  }
  if (!best) return std::nullopt;
  return folder / *best;
}

std::optional<fs::path> find_path_without_case(const fs::path& path) {
  fs::path found = path.root_path();
  for (const fs::path& part : path.relative_path()) {
    fs::path exact = found / part;
    std::error_code failure;
    if (fs::exists(exact, failure)) {
      found = exact;
      continue;
    }
    std::optional<fs::path> other = find_without_case(found, part.string());
    if (!other) return std::nullopt;
    found = *other;
  }
  return found;
}

}  // namespace

std::string normalize_path(std::string_view path) {
  std::string text(path);
  std::replace(text.begin(), text.end(), '\\', '/');
  if (text.empty()) return text;
  return fs::path(text).lexically_normal().generic_string();
}

std::optional<LoadedFile> DiskFileLoader::load(const std::string& path, std::string* error) {
  if (path.find('\0') != std::string::npos) return std::nullopt;
  std::error_code failure;
  fs::path found = path;
  if (!fs::exists(found, failure)) {
    std::optional<fs::path> other = find_path_without_case(found);
    if (!other) return std::nullopt;
    found = *other;
  }
  // A folder is not a file: the next search folder may have a file of that name.
  if (fs::is_directory(found, failure)) return std::nullopt;
  if (!fs::is_regular_file(found, failure)) {
    if (error) *error = "it is a device or a pipe, not a file";
    return std::nullopt;
  }
  uintmax_t size = fs::file_size(found, failure);
  if (!failure && size > kMaxBytes) {
    if (error) {
      *error = "the file has " + std::to_string(size) + " bytes; at most " +
               std::to_string(kMaxBytes) + " are allowed";
    }
    return std::nullopt;
  }
  std::ifstream stream(found, std::ios::binary);
  LoadedFile file;
  if (!failure) file.text.resize(size);
  stream.read(file.text.data(), static_cast<std::streamsize>(file.text.size()));
  if (failure || !stream) {
    if (error) *error = "the file cannot be read; are its permissions right?";
    return std::nullopt;
  }
  file.path = found.generic_string();
  fs::path canonical = fs::canonical(found, failure);
  file.canonical = failure ? file.path : canonical.generic_string();
  return file;
}

std::optional<LoadedFile> MemoryFileLoader::load(const std::string& path, std::string*) {
  std::string normal = normalize_path(path);
  auto found = files_.find(normal);
  if (found == files_.end()) {
    found = std::find_if(files_.begin(), files_.end(),
                         [&](const auto& file) { return equal_without_case(file.first, normal); });
  }
  if (found == files_.end()) return std::nullopt;
  return LoadedFile{found->first, found->first, found->second};
}

}  // namespace kaamos::hlsl
