// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/generated_header.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "d3d12/vcxproj/paths.h"

namespace kaamos::vcxproj {
namespace {

namespace fs = std::filesystem;

// The names in `#include "..."` lines of a file.
void add_includes(const fs::path& file, std::vector<std::string>& names) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::string text = trim(line);
    if (!text.starts_with('#') || !trim(text.substr(1)).starts_with("include")) continue;
    const size_t begin = text.find_first_of("\"<");
    const size_t end = text.find_last_of("\">");
    if (begin != std::string::npos && end > begin) {
      names.push_back(slashes(text.substr(begin + 1, end - begin - 1)));
    }
  }
}

// Whether the path ends in the name, folder for folder.
bool ends_in(const fs::path& path, const std::string& name) {
  const fs::path wanted(name);
  const auto parts = std::distance(path.begin(), path.end());
  const auto wanted_parts = std::distance(wanted.begin(), wanted.end());
  if (name.empty() || wanted_parts > parts) return false;
  return std::equal(
      wanted.begin(), wanted.end(), std::next(path.begin(), parts - wanted_parts),
      [](const fs::path& a, const fs::path& b) { return same(a.string(), b.string()); });
}

std::string name_of(const Project& project, const std::vector<std::string>& included,
                    const fs::path& header) {
  for (const std::string& name : included) {
    if (ends_in(header, name)) return name;
  }
  std::optional<std::string> shortest;
  for (const fs::path& folder : project.includes) {
    const auto name = path_below(folder, header);
    if (name && (!shortest || name->size() < shortest->size())) shortest = name;
  }
  if (!shortest) shortest = path_below(project.file.parent_path(), header);
  return shortest.value_or(header.filename().string());
}

}  // namespace

void name_generated_headers(Project& project) {
  std::vector<std::string> included;
  for (const auto* files : {&project.sources, &project.headers}) {
    for (const fs::path& file : *files) add_includes(file, included);
  }
  for (Shader& shader : project.shaders) {
    if (!shader.header_path.empty()) {
      shader.header = name_of(project, included, shader.header_path);
    }
  }
}

}  // namespace kaamos::vcxproj
