// SPDX-License-Identifier: MIT
// Reads files for the compiler: from disk, or from memory in tests and for shaders made at run
// time.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace kaamos::hlsl {

struct LoadedFile {
  std::string path;       // As found: the spelling on disk if the request differs in case.
  std::string canonical;  // The same for all spellings of one file; #pragma once compares it.
  std::string text;
};

class FileLoader {
 public:
  virtual ~FileLoader() = default;
  // `path` uses `/`. On nullopt, `error` is empty if there is no such file, and set if the file
  // exists but cannot be read.
  virtual std::optional<LoadedFile> load(const std::string& path, std::string* error) = 0;
};

// Tries the exact name first, then ignores case, as Windows does.
class DiskFileLoader : public FileLoader {
 public:
  static constexpr size_t kMaxBytes = size_t{64} << 20;
  std::optional<LoadedFile> load(const std::string& path, std::string* error) override;
};

// Files by normalised path ("a/b.hlsli"), with the same look-up rules as on disk.
class MemoryFileLoader : public FileLoader {
 public:
  MemoryFileLoader() = default;
  explicit MemoryFileLoader(std::map<std::string, std::string> files) : files_(std::move(files)) {}
  void add(std::string path, std::string text) { files_[std::move(path)] = std::move(text); }
  std::optional<LoadedFile> load(const std::string& path, std::string* error) override;

 private:
  std::map<std::string, std::string> files_;
};

// `\` becomes `/`; `.` and `..` are resolved as far as the text allows.
std::string normalize_path(std::string_view path);

}  // namespace kaamos::hlsl
