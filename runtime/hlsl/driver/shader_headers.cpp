// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/shader_headers.h"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "runtime/files/write_file.h"
#include "runtime/hlsl/driver/files.h"
#include "runtime/hlsl/driver/shader_cache.h"

namespace kaamos::hlsl {

// The files of runtime/shader/include/kaamos/shader, names and texts (cmake/KaamosEmbed.cmake).
extern const std::pair<std::string_view, std::string_view> kShaderHeaders[];

namespace {

namespace fs = std::filesystem;

constexpr char kHeaderFolder[] = "kaamos/shader";

void add_header(std::string& all, std::string_view name, std::string_view text) {
  (all += '\0').append(name);
  (all += '\0').append(text);
}

}  // namespace

std::string shader_headers_text(const fs::path& folder) {
  std::string all;
  if (folder.empty()) {
    for (const auto* header = kShaderHeaders; !header->first.empty(); ++header) {
      add_header(all, header->first, header->second);
    }
    return all;
  }
  std::error_code ignored;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / kHeaderFolder, ignored)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) add_header(all, file.filename().string(), read_file(file));
  return all;
}

Result<fs::path> write_shader_headers(const fs::path& cache) {
  // Versions of the library that share a cache have a folder each.
  static const std::string version = content_hash(shader_headers_text({}));
  const fs::path folder = cache / ("headers-" + version);
  std::error_code ignored;
  fs::create_directories(folder / kHeaderFolder, ignored);
  for (const auto* header = kShaderHeaders; !header->first.empty(); ++header) {
    const fs::path file = folder / kHeaderFolder / header->first;
    if (read_file(file) != header->second && files::write_file(file, header->second) != 0) {
      return Failure{cannot_write(file)};
    }
  }
  return folder;
}

}  // namespace kaamos::hlsl
