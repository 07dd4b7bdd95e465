// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/project.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "d3d12/vcxproj/command.h"
#include "d3d12/vcxproj/content.h"
#include "d3d12/vcxproj/evaluation.h"
#include "d3d12/vcxproj/generated_header.h"
#include "d3d12/vcxproj/host_options.h"
#include "d3d12/vcxproj/paths.h"
#include "d3d12/vcxproj/shader_item.h"

namespace kaamos::vcxproj {
namespace {

namespace fs = std::filesystem;

// What kaamos::d3d12 and kaamos::d3d12_main stand for, and what every project of Visual Studio
// lists.
constexpr std::array<std::string_view, 20> kLibraries = {
    "advapi32", "comdlg32", "d3d12",    "d3dcompiler", "dxcompiler", "dxcore", "dxgi",
    "dxguid",   "gdi32",    "kernel32", "odbc32",      "odbccp32",   "ole32",  "oleaut32",
    "shell32",  "shlwapi",  "user32",   "uuid",        "winspool",   "ws2_32"};

constexpr std::array<std::string_view, 9> kContentTypes = {
    "None", "Image", "Content", "CopyFileToFolders", "Text", "Media", "Font", "Xml", "Document"};

template <size_t n>
bool is_one_of(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view each) { return same(each, name); });
}

class Importer {
 public:
  Importer(Project& out, const NameMap& fixed, Notes& notes)
      : out_(out), fixed_(fixed), notes_(notes) {}

  bool import(const fs::path& file) {
    visited_.insert(file);
    std::optional<Evaluation> evaluation = evaluate(file, fixed_, notes_);
    if (!evaluation) return false;
    const Properties& properties = evaluation->properties;
    if (out_.file.empty()) {
      out_.file = file;
      out_.name = properties.get("ProjectName");
      out_.type = properties.get("ConfigurationType");
      out_.configuration = properties.get("Configuration");
    } else if (!same(properties.get("ConfigurationType"), "StaticLibrary")) {
      notes_.add(Topic::kReferences, file.filename().string() + " is no static library (" +
                                         properties.get("ConfigurationType") + "), left out");
      return true;
    } else {
      notes_.add(Topic::kReferences,
                 file.filename().string() + " is a static library: its sources are the program's");
    }
    outputs_.push_back(lower(properties.get("TargetName")));
    for (const Item& item : evaluation->items) add(*evaluation, item);
    add_host_options(*evaluation, out_, notes_);
    for (const char* event :
         {"PreBuildEvent", "PreLinkEvent", "PostBuildEvent", "CustomBuildStep"}) {
      const std::string text = properties.expand(evaluation->definition(event, "Command"));
      add_commands(*evaluation, event, text, Item{event, "", properties.folder(), {}});
    }
    for (const char* linker : {"Link", "Lib"}) {
      for (const std::string& name :
           split_list(evaluation->definition(linker, "AdditionalDependencies"))) {
        libraries_.push_back(name);
      }
    }
    return notes_.errors().empty();
  }

  void finish() {
    for (const std::string& library : libraries_) {
      std::string name = lower(fs::path(slashes(library)).filename().string());
      if (name.ends_with(".lib")) name.resize(name.size() - 4);
      const bool own = std::find(outputs_.begin(), outputs_.end(), name) != outputs_.end();
      if (!own && !name.starts_with('%') && !is_one_of(kLibraries, name)) {
        notes_.add(Topic::kLibraries, library);
      }
    }
    name_generated_headers(out_);
    name_objects();
  }

 private:
  void add(const Evaluation& evaluation, const Item& item) {
    if (same(item.type, "ProjectConfiguration") || same(item.type, "ProjectCapability") ||
        same(item.type, "Filter") || item.is("ExcludedFromBuild")) {
      return;
    }
    if (same(item.type, "ProjectReference")) return add_reference(item);
    const std::optional<fs::path> file = find_path(item.folder, item.include);
    if (same(item.type, "ClInclude")) {
      if (file) out_.headers.push_back(*file);
    } else if (same(item.type, "ClCompile")) {
      if (found(item, file)) add_source(*file);
    } else if (same(item.type, "FxCompile")) {
      if (!found(item, file)) return;
      if (auto shader = shader_of_item(evaluation, item, *file, notes_)) add_shader(*shader);
    } else if (same(item.type, "CustomBuild")) {
      if (found(item, file)) add_custom_build(evaluation, item, *file);
    } else if (is_one_of(kContentTypes, item.type)) {
      if (is_copied(item) && found(item, file)) {
        add_content({*file, destination_of(evaluation, item)});
      }
    } else {
      notes_.add(Topic::kItems, item.type + " " + item.include);
    }
  }

  bool found(const Item& item, const std::optional<fs::path>& file) {
    if (!file) notes_.add(Topic::kMissing, item.type + " " + item.include);
    return file.has_value();
  }

  void add_reference(const Item& item) {
    const std::optional<fs::path> file = find_path(item.folder, item.include);
    if (found(item, file) && visited_.count(*file) == 0) import(*file);
  }

  void add_source(const fs::path& file) {
    if (std::find(out_.sources.begin(), out_.sources.end(), file) == out_.sources.end()) {
      out_.sources.push_back(file);
    }
  }

  void add_shader(const Shader& shader) { out_.shaders.push_back(shader); }

  void add_content(const Content& content) {
    const bool known =
        std::any_of(out_.contents.begin(), out_.contents.end(),
                    [&](const Content& each) { return each.destination == content.destination; });
    if (!known) out_.contents.push_back(content);
  }

  void add_custom_build(const Evaluation& evaluation, const Item& item, const fs::path& file) {
    const std::string command = item.value("Command");
    if (trim(command).empty() && is_copied(item)) {
      return add_content({file, destination_of(evaluation, item)});
    }
    add_commands(evaluation, item.include, command, item);
  }

  void add_commands(const Evaluation& evaluation, const std::string& what, const std::string& text,
                    const Item& item) {
    for (const Command& command : parse_commands(text)) {
      bool known = command.kind == Command::Kind::kNothing;
      if (command.kind == Command::Kind::kDxc) {
        const auto shader = shader_of_command(evaluation, item, command, notes_);
        if (shader) add_shader(*shader);
        known = true;  // or noted
      } else if (command.kind == Command::Kind::kCopy) {
        const std::vector<Content> copies = contents_of_copy(evaluation, command);
        for (const Content& content : copies) add_content(content);
        known = !copies.empty();
      }
      if (!known) notes_.add(Topic::kCommands, what + ": " + command.text);
    }
  }

  // Two shaders cannot have one object file.
  void name_objects() {
    std::set<std::string> taken;
    for (Shader& shader : out_.shaders) {
      for (int i = 2; !taken.insert(lower(shader.object)).second; ++i) {
        fs::path object = shader.object;
        object.replace_filename(object.stem().string() + "_" + std::to_string(i) + ".cso");
        notes_.add(Topic::kShaders, shader.source.filename().string() + ": another shader is " +
                                        shader.object + "; its object is " +
                                        object.generic_string());
        shader.object = object.generic_string();
      }
    }
  }

  Project& out_;
  const NameMap& fixed_;
  Notes& notes_;
  std::set<fs::path> visited_;
  std::vector<std::string> outputs_;  // of the projects that are imported, in lower case
  std::vector<std::string> libraries_;
};

}  // namespace

std::optional<Project> import_project(const fs::path& file, const NameMap& fixed, Notes& notes) {
  Project out;
  Importer importer(out, fixed, notes);
  if (!importer.import(file)) return std::nullopt;
  importer.finish();
  return out;
}

}  // namespace kaamos::vcxproj
