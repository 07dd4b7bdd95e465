// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/properties.h"

#include <system_error>
#include <vector>

#include "d3d12/vcxproj/paths.h"

namespace kaamos::vcxproj {
namespace {

namespace fs = std::filesystem;

std::string with_slash(const fs::path& folder) {
  const std::string text = folder.string();
  return text.ends_with('/') ? text : text + "/";
}

// The nearest folder upward that has a solution; the project's own without one.
fs::path solution_folder(const fs::path& project_folder) {
  for (fs::path folder = project_folder;; folder = folder.parent_path()) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
      const std::string extension = lower(it->path().extension().string());
      if (extension == ".sln" || extension == ".slnx") return folder;
    }
    if (folder == folder.parent_path()) return project_folder;
  }
}

// The position behind the parenthesis that closes the one at `open`.
size_t closing(std::string_view text, size_t open) {
  int depth = 0;
  for (size_t i = open; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i + 1;
  }
  return std::string_view::npos;
}

// Replaces each reference `mark`(...) by what `value` gives for the text inside; nothing keeps it.
std::string replace_references(
    std::string_view text, char mark,
    const std::function<std::optional<std::string>(std::string_view)>& value) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t end = text[at] == mark && at + 1 < text.size() && text[at + 1] == '('
                           ? closing(text, at + 1)
                           : std::string_view::npos;
    if (end == std::string_view::npos) {
      out += text[at++];
      continue;
    }
    const auto replaced = value(text.substr(at + 2, end - at - 3));
    out += replaced ? *replaced : std::string(text.substr(at, end - at));
    at = end;
  }
  return out;
}

// The nearest folder from `start` upward that has the file; "" without one.
std::string folder_above(const fs::path& start, const std::string& file) {
  for (fs::path folder = absolute_path("/", start.string());; folder = folder.parent_path()) {
    if (find_path(folder, file)) return folder.string();
    if (folder == folder.parent_path()) return {};
  }
}

// The arguments of "f(a, 'b')" behind the parenthesis at `open`.
std::vector<std::string> arguments_of(std::string_view call, size_t open) {
  std::vector<std::string> arguments;
  const size_t end = closing(call, open);
  if (end == std::string_view::npos) return arguments;
  std::string list(call.substr(open + 1, end - open - 2));
  for (char& c : list) c = c == ',' ? ';' : c;
  for (std::string argument : split_list(list)) {
    std::erase(argument, '\'');
    arguments.push_back(trim(argument));
  }
  return arguments;
}

// The two functions of MSBuild by which projects find what they import.
std::optional<std::string> call_function(const std::string& call) {
  const size_t open = call.find('(');
  if (open == std::string::npos) return std::nullopt;
  const std::vector<std::string> arguments = arguments_of(call, open);
  const std::string name = call.substr(0, open);
  if (arguments.size() != 2) return std::nullopt;
  if (same(name, "[MSBuild]::GetDirectoryNameOfFileAbove")) {
    return folder_above(slashes(arguments[0]), arguments[1]);
  }
  if (same(name, "[MSBuild]::GetPathOfFileAbove")) {
    const std::string folder = folder_above(slashes(arguments[1]), arguments[0]);
    return folder.empty() ? "" : folder + "/" + arguments[0];
  }
  return std::nullopt;
}

}  // namespace

Properties::Properties(const fs::path& project, const NameMap& fixed, Notes& notes)
    : project_(project), fixed_(fixed), notes_(&notes) {
  const std::string name = project.stem().string();
  const std::string folder_text = with_slash(project.parent_path());
  values_ = {{"ProjectDir", folder_text},
             {"ProjectPath", project.string()},
             {"ProjectFileName", project.filename().string()},
             {"ProjectExt", project.extension().string()},
             {"MSBuildProjectName", name},
             {"MSBuildProjectFile", project.filename().string()},
             {"MSBuildProjectFullPath", project.string()},
             {"MSBuildProjectDirectory", project.parent_path().string()},
             {"MSBuildProjectExtension", project.extension().string()},
             {"ProjectName", name},
             {"TargetExt", ".exe"},
             {"OS", "Windows_NT"},
             {"PlatformToolset", "v143"},
             {"DefaultPlatformToolset", "v143"},
             {"VisualStudioVersion", "17.0"},
             {"ConfigurationType", "Application"},
             {"SolutionDir", with_slash(solution_folder(project.parent_path()))}};
  for (const auto& [key, value] : fixed_) values_[key] = value;
  set("PlatformTarget", get("Platform"));
  set("PlatformShortName", get("Platform"));
  // What Microsoft.Cpp.Default.props says.
  set("OutDir", get("SolutionDir") + get("Platform") + "/" + get("Configuration") + "/");
  set("IntDir", get("Platform") + "/" + get("Configuration") + "/");
  set_file(project);
}

void Properties::set(const std::string& name, const std::string& value) {
  if (fixed_.count(name) == 0) values_[name] = value;
}

std::string Properties::get(const std::string& name) const {
  if (const auto found = values_.find(name); found != values_.end()) return found->second;
  if (same(name, "TargetName")) return get("ProjectName");
  if (same(name, "TargetDir")) return get("OutDir");
  if (same(name, "TargetFileName")) return get("TargetName") + get("TargetExt");
  if (same(name, "TargetPath")) return get("OutDir") + get("TargetFileName");
  return {};
}

std::string Properties::expand(std::string_view text) const {
  return replace_references(text, '$', [&](std::string_view inside) -> std::optional<std::string> {
    const std::string name = trim(inside);
    if (name.find_first_of("[.(:") != std::string::npos) {
      if (const auto value = call_function(expand(name))) return *value;
      notes_->add(Topic::kItems, "$(" + name + "): calls in properties; taken for nothing");
      return "";
    }
    return get(name);
  });
}

void Properties::set_file(const fs::path& file) {
  values_["MSBuildThisFile"] = file.filename().string();
  values_["MSBuildThisFileName"] = file.stem().string();
  values_["MSBuildThisFileExtension"] = file.extension().string();
  values_["MSBuildThisFileFullPath"] = file.string();
  values_["MSBuildThisFileDirectory"] = with_slash(file.parent_path());
}

std::string expand_metadata(std::string_view text, const MetadataLookup& lookup) {
  return replace_references(text, '%', [&](std::string_view inside) {
    const std::string name = trim(inside);
    const size_t dot = name.find('.');
    return lookup(dot == std::string::npos ? name : name.substr(dot + 1));
  });
}

}  // namespace kaamos::vcxproj
