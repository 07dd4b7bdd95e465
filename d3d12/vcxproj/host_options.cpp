// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/host_options.h"

#include <algorithm>
#include <functional>

#include "d3d12/vcxproj/command.h"
#include "d3d12/vcxproj/paths.h"

namespace kaamos::vcxproj {
namespace {

namespace fs = std::filesystem;

class HostOptions {
 public:
  HostOptions(const Evaluation& evaluation, Project& project, Notes& notes)
      : evaluation_(evaluation), out_(project), notes_(notes) {}

  void add() {
    add_character_set();
    const Item defaults{"ClCompile", "", evaluation_.properties.folder(), defaults_of("ClCompile")};
    add_settings(defaults, "");
    for (const Item& item : evaluation_.items) {
      if (same(item.type, "ClCompile") && !item.is("ExcludedFromBuild")) {
        add_settings(item, item.include);
      }
    }
    // Visual Studio's own folders, and folders that its other projects write to, are among these.
    for (const std::string& entry : split_list(evaluation_.properties.get("IncludePath"))) {
      if (find_path(evaluation_.properties.folder(), entry)) add_folders(entry);
    }
    if (!out_.forced_includes.empty()) add_folders(".");  // which they are relative to
  }

 private:
  NameMap defaults_of(const std::string& type) const {
    const auto found = evaluation_.definitions.find(type);
    return found == evaluation_.definitions.end() ? NameMap() : found->second;
  }

  void add_character_set() {
    const std::string set = evaluation_.properties.get("CharacterSet");
    if (same(set, "Unicode")) {
      add_once(out_.defines, "UNICODE");
      add_once(out_.defines, "_UNICODE");
    } else if (same(set, "MultiByte")) {
      add_once(out_.defines, "_MBCS");
    }
  }

  // `source` is "" for the defaults.
  void add_settings(const Item& item, const std::string& source) {
    add_folders(item.value("AdditionalIncludeDirectories"));
    for (const std::string& define : split_list(item.value("PreprocessorDefinitions"))) {
      // kaamos_add_d3d12_program defines these by build type.
      if (define != "NDEBUG" && define != "_DEBUG") add_to(out_.defines, define, source, "define");
    }
    for (const std::string& file : split_list(item.value("ForcedIncludeFiles"))) {
      add_to(out_.forced_includes, slashes(file), source, "forced include");
    }
    for (const std::string& name : split_list(item.value("UndefinePreprocessorDefinitions"))) {
      add_to(out_.options, "-U" + name, source, "option");
    }
    add_alignment(trim(item.value("StructMemberAlignment")), source);
    add_standard(trim(item.value("LanguageStandard")), source);
    for (const std::string& word : split_words(item.value("AdditionalOptions"))) {
      add_option(word, source);
    }
  }

  void add_to(std::vector<std::string>& list, const std::string& value, const std::string& source,
              const std::string& what) {
    if (std::find(list.begin(), list.end(), value) != list.end()) return;
    list.push_back(value);
    if (!source.empty()) {
      notes_.add(Topic::kOptions, source + ": its " + what + " " + value + " goes to all sources");
    }
  }

  void add_folders(std::string_view list) {
    for (const fs::path& folder : include_folders(evaluation_, list, notes_)) {
      if (std::find(out_.includes.begin(), out_.includes.end(), folder) == out_.includes.end()) {
        out_.includes.push_back(folder);
      }
    }
  }

  // "1Byte" to "16Bytes", or what follows /Zp. 16 is the compilers' own.
  void add_alignment(const std::string& value, const std::string& source) {
    const std::string bytes = value.substr(0, value.find_first_not_of("0123456789"));
    if (bytes == "1" || bytes == "2" || bytes == "4" || bytes == "8") {
      add_to(out_.options, "-fpack-struct=" + bytes, source, "option");
    }
  }

  void add_standard(const std::string& value, const std::string& source) {
    const std::string standard = lower(value);
    if (standard == "stdcpp20" || standard == "c++20") {
      add_to(out_.options, "-std=gnu++20", source, "option");
    } else if (standard == "stdcpplatest" || standard == "c++latest" || standard == "stdcpp23") {
      add_to(out_.options, "-std=gnu++2b", source, "option");
    }
  }

  void add_option(const std::string& word, const std::string& source) {
    const std::string option =
        word.size() > 1 && (word[0] == '/' || word[0] == '-') ? word.substr(1) : std::string();
    if (option.starts_with("D") && option.size() > 1) {
      add_to(out_.defines, option.substr(1), source, "define");
    } else if (option.starts_with("U") && option.size() > 1) {
      add_to(out_.options, "-" + option, source, "option");
    } else if (option.starts_with("FI") && option.size() > 2) {
      add_to(out_.forced_includes, slashes(option.substr(2)), source, "forced include");
    } else if (option.starts_with("I") && option.size() > 1) {
      add_folders(option.substr(1));
    } else if (option.starts_with("Zp")) {
      add_alignment(option == "Zp" ? "1" : option.substr(2), source);
    } else if (option.starts_with("std:")) {
      add_standard(option.substr(4), source);
    } else if (!is_without_effect(option)) {
      notes_.add(Topic::kOptions, "of cl, left out: " + word);
    }
  }

  // Warnings, code generation, character sets of sources: clang needs no counterpart.
  static bool is_without_effect(const std::string& option) {
    for (const char* start :
         {"bigobj",      "utf-8", "permissive", "Zc:", "MP",        "W",
          "w",           "wd",    "O",          "FS",  "GS",        "nologo",
          "diagnostics", "EH",    "Zi",         "Z7",  "Fd",        "MD",
          "MT",          "sdl",   "guard",      "Zm",  "external:", "source-charset"}) {
      if (option.starts_with(start)) return true;
    }
    return false;
  }

  const Evaluation& evaluation_;
  Project& out_;
  Notes& notes_;
};

}  // namespace

void add_host_options(const Evaluation& evaluation, Project& project, Notes& notes) {
  HostOptions(evaluation, project, notes).add();
}

std::vector<fs::path> include_folders(const Evaluation& evaluation, std::string_view list,
                                      Notes& notes) {
  const Properties& properties = evaluation.properties;
  std::vector<fs::path> folders;
  for (const std::string& entry : split_list(list)) {
    if (const auto folder = find_path(properties.folder(), entry)) {
      folders.push_back(*folder);
      continue;
    }
    const fs::path wanted = absolute_path(properties.folder(), entry);
    const auto is_made = [&](const char* made) {
      const std::string path = properties.get(made);
      return !path.empty() && path_below(absolute_path(properties.folder(), path), wanted);
    };
    if (!is_made("IntDir") && !is_made("OutDir")) {
      notes.add(Topic::kMissing, "include folder " + slashes(entry));
    }
  }
  return folders;
}

}  // namespace kaamos::vcxproj
