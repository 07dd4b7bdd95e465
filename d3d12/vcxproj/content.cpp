// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/content.h"

#include "d3d12/vcxproj/paths.h"

namespace kaamos::vcxproj {
namespace {

namespace fs = std::filesystem;

// "../a/./b" as "a/b": nothing is written outside the program's folder.
std::string inside(const std::string& path) {
  fs::path out;
  for (const fs::path& part : fs::path(path).lexically_normal().relative_path()) {
    if (part != ".." && part != ".") out /= part;
  }
  return out.generic_string();
}

}  // namespace

std::string below_output(const Evaluation& evaluation, std::string_view path) {
  const Properties& properties = evaluation.properties;
  const fs::path out = absolute_path(properties.folder(), properties.get("OutDir"));
  const fs::path target = absolute_path(properties.folder(), path);
  const std::optional<std::string> below = path_below(out, target);
  if (below) return *below == "." ? "" : *below;
  return target.filename().string();
}

bool is_copied(const Item& item) {
  const std::string output = trim(item.value("CopyToOutputDirectory"));
  const std::string deployed = trim(item.value("DeploymentContent"));
  if (same(output, "Never") || (output.empty() && same(deployed, "false"))) return false;
  if (!output.empty() || same(deployed, "true")) return true;
  return same(item.type, "Content") || same(item.type, "CopyFileToFolders");
}

std::string destination_of(const Evaluation& evaluation, const Item& item) {
  const std::string name = item.path().filename().string();
  for (const char* metadata : {"TargetPath", "Link"}) {
    const std::string path = slashes(item.value(metadata));
    if (!path.empty()) return inside(path);
  }
  if (same(item.type, "CopyFileToFolders")) {
    const std::vector<std::string> folders = split_list(item.value("DestinationFolders"));
    const std::string renamed = slashes(item.value("DestinationFileName"));
    const std::string folder = folders.empty() ? "" : below_output(evaluation, folders.front());
    return inside((fs::path(folder) / (renamed.empty() ? name : renamed)).generic_string());
  }
  return inside(slashes(item.include));
}

std::vector<Content> contents_of_copy(const Evaluation& evaluation, const Command& command) {
  const fs::path folder = evaluation.properties.folder();
  std::vector<fs::path> files;
  if (has_wildcard(command.arguments[0])) {
    files = find_wildcard(folder, command.arguments[0]);
  } else if (const auto file = find_path(folder, command.arguments[0])) {
    std::error_code error;
    if (fs::is_regular_file(*file, error)) files.push_back(*file);
  }
  const std::string& target = command.arguments[1];
  const fs::path below = below_output(evaluation, target);
  // cmd.exe looks whether the target is a folder. None is here yet, and folders have no extension.
  const bool is_file =
      below.has_extension() && !slashes(target).ends_with('/') && files.size() == 1;
  std::vector<Content> contents;
  for (const fs::path& file : files) {
    const fs::path destination = is_file ? below : below / file.filename();
    contents.push_back({file, inside(destination.generic_string())});
  }
  return contents;
}

}  // namespace kaamos::vcxproj
