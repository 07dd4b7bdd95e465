// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/evaluation.h"

#include <algorithm>
#include <memory>
#include <pugixml.hpp>
#include <set>

#include "d3d12/vcxproj/condition.h"
#include "d3d12/vcxproj/item_metadata.h"
#include "d3d12/vcxproj/paths.h"

namespace kaamos::vcxproj {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepestImport = 64;

bool named(const pugi::xml_node& node, std::string_view name) {
  return same(node.name(), name);
}

// Imports of Visual Studio's own files and of a user's settings, which are on no other machine.
bool is_of_visual_studio(std::string_view path) {
  for (const char* start : {"$(VCTargetsPath", "$(MSBuildExtensionsPath", "$(MSBuildToolsPath",
                            "$(UserRootDir)", "$(VSINSTALLDIR)", "$(VCInstallDir)"}) {
    if (starts_with_any_case(path, start)) return true;
  }
  return false;
}

class Evaluator {
 public:
  Evaluator(Evaluation& out, Notes& notes) : out_(out), notes_(notes) {}

  bool run() {
    read_file(out_.properties.project());
    if (!notes_.errors().empty()) return false;
    for (const Later& group : definitions_) define(group);
    for (const Later& group : items_) add_items(group);
    return notes_.errors().empty();
  }

 private:
  // A group that is evaluated once all properties are known.
  struct Later {
    pugi::xml_node node;
    fs::path file;
  };

  bool holds(const pugi::xml_node& node) {
    const std::string condition = node.attribute("Condition").value();
    const std::optional<bool> value =
        evaluate_condition(out_.properties.expand(condition), out_.properties.folder());
    if (!value) notes_.add(Topic::kConditions, condition);
    return value.value_or(false);
  }

  void read_file(const fs::path& file) {
    auto document = std::make_unique<pugi::xml_document>();
    const pugi::xml_parse_result result = document->load_file(file.c_str());
    if (result.status == pugi::status_file_not_found || result.status == pugi::status_io_error) {
      return notes_.error(file.string() + ": cannot be read. Give the path of a .vcxproj file.");
    }
    if (!result) {
      return notes_.error(file.string() + ": damaged XML at byte " + std::to_string(result.offset) +
                          ": " + result.description());
    }
    const pugi::xml_node root = document->document_element();
    if (!named(root, "Project")) {
      return notes_.error(file.string() + ": begins with <" + root.name() +
                          ">, not with <Project>: no file of MSBuild");
    }
    documents_.push_back(std::move(document));
    open_.push_back(file);
    out_.properties.set_file(file);
    read_children(root);
    open_.pop_back();
    if (!open_.empty()) out_.properties.set_file(open_.back());
  }

  void read_children(const pugi::xml_node& parent) {
    for (const pugi::xml_node& node : parent.children()) {
      if (node.type() != pugi::node_element) continue;
      if (named(node, "PropertyGroup")) {
        if (holds(node)) set_properties(node);
      } else if (named(node, "ImportGroup")) {
        if (holds(node)) read_children(node);
      } else if (named(node, "Import")) {
        import(node);
      } else if (named(node, "ItemDefinitionGroup")) {
        definitions_.push_back({node, open_.back()});
      } else if (named(node, "ItemGroup")) {
        items_.push_back({node, open_.back()});
      } else if (named(node, "Choose")) {
        choose(node);
      } else if (named(node, "Target")) {
        read_target(node);
      } else if (!named(node, "ProjectExtensions")) {
        notes_.add(Topic::kItems, std::string("<") + node.name() + ">");
      }
    }
  }

  // A target that only checks whether packages of NuGet are there says nothing of what is built.
  void read_target(const pugi::xml_node& node) {
    const std::string name = node.attribute("Name").value();
    if (name != "EnsureNuGetPackageBuildImports") notes_.add(Topic::kItems, "target " + name);
  }

  void choose(const pugi::xml_node& node) {
    for (const pugi::xml_node& branch : node.children()) {
      const bool taken = named(branch, "Otherwise") || (named(branch, "When") && holds(branch));
      if (taken) return read_children(branch);
    }
  }

  void set_properties(const pugi::xml_node& group) {
    for (const pugi::xml_node& node : group.children()) {
      if (node.type() == pugi::node_element && holds(node)) {
        out_.properties.set(node.name(), trim(out_.properties.expand(node.text().get())));
      }
    }
  }

  void import(const pugi::xml_node& node) {
    const std::string raw = node.attribute("Project").value();
    if (is_of_visual_studio(raw) || !holds(node)) return;
    const std::string text = out_.properties.expand(raw);
    const fs::path folder = open_.back().parent_path();
    std::vector<fs::path> files;
    if (has_wildcard(text)) {
      files = find_wildcard(folder, text);
    } else if (const auto file = find_path(folder, text)) {
      files.push_back(*file);
    } else {
      notes_.add(Topic::kMissing, raw + " (import of " + open_.back().filename().string() + ")");
    }
    for (const fs::path& file : files) import_file(file);
  }

  void import_file(const fs::path& file) {
    if (std::find(open_.begin(), open_.end(), file) != open_.end()) {
      std::string chain;
      for (const fs::path& each : open_) chain += each.filename().string() + " > ";
      return notes_.error(open_.back().string() + ": imports in a circle: " + chain +
                          file.filename().string() + ". Remove one of these imports.");
    }
    if (open_.size() > kDeepestImport) {
      return notes_.error(open_.back().string() + ": imports are nested more than " +
                          std::to_string(kDeepestImport) + " deep");
    }
    if (imported_.insert(file).second) read_file(file);  // as MSBuild, each file once
  }

  void define(const Later& group) {
    out_.properties.set_file(group.file);
    if (!holds(group.node)) return;
    for (const pugi::xml_node& type : group.node.children()) {
      if (type.type() != pugi::node_element || !holds(type)) continue;
      NameMap& defaults = out_.definitions[type.name()];
      for (const pugi::xml_node& node : type.children()) {
        if (node.type() != pugi::node_element || !holds(node)) continue;
        const MetadataLookup lookup = [&](const std::string& name) -> std::optional<std::string> {
          if (is_well_known(name)) return std::nullopt;  // known once there is an item
          const auto found = defaults.find(name);
          return found == defaults.end() ? "" : found->second;
        };
        defaults[node.name()] = expand_metadata(out_.properties.expand(node.text().get()), lookup);
      }
    }
  }

  void add_items(const Later& group) {
    out_.properties.set_file(group.file);
    if (!holds(group.node)) return;
    for (const pugi::xml_node& node : group.node.children()) {
      if (node.type() != pugi::node_element || !holds(node)) continue;
      const std::string include = out_.properties.expand(node.attribute("Include").value());
      const std::string exclude = out_.properties.expand(node.attribute("Exclude").value());
      if (node.attribute("Remove")) {
        remove(node.name(), out_.properties.expand(node.attribute("Remove").value()));
      } else if (node.attribute("Update")) {
        update(node, out_.properties.expand(node.attribute("Update").value()));
      } else {
        for (const std::string& entry : split_list(include)) add_item(node, entry, exclude);
      }
    }
  }

  void add_item(const pugi::xml_node& node, const std::string& entry, const std::string& exclude) {
    const fs::path folder = out_.properties.folder();  // MSBuild: of the project, not of the import
    if (entry.find("@(") != std::string::npos) {
      return notes_.add(Topic::kItems,
                        std::string(node.name()) + " " + entry + ": a list of items");
    }
    std::vector<std::string> includes = {entry};
    if (has_wildcard(entry)) {
      includes.clear();
      for (const fs::path& file : find_wildcard(folder, entry)) {
        includes.push_back(file.lexically_relative(folder).generic_string());
      }
      if (includes.empty()) {
        notes_.add(Topic::kMissing, std::string(node.name()) + " " + entry + ": no file matches");
      }
    }
    for (const std::string& include : includes) {
      Item item{node.name(), include, folder, {}};
      if (names(exclude, item)) continue;
      const auto defaults = out_.definitions.find(node.name());
      if (defaults != out_.definitions.end()) item.metadata = defaults->second;
      set_metadata(node, item);
      out_.items.push_back(std::move(item));
    }
  }

  void set_metadata(const pugi::xml_node& node, Item& item) {
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      // Conditions may refer to %(Filename) and other metadata.
      const std::string condition = child.attribute("Condition").value();
      const auto value = [&](std::string_view text) {
        return expand_metadata(out_.properties.expand(text),
                               [&](const std::string& name) { return item.value(name); });
      };
      const std::optional<bool> holds_here =
          evaluate_condition(value(condition), out_.properties.folder());
      if (!holds_here) notes_.add(Topic::kConditions, condition);
      if (holds_here.value_or(false)) item.metadata[child.name()] = value(child.text().get());
    }
  }

  // Whether an entry of `list` names the item's file.
  static bool names(const std::string& list, const Item& item) {
    for (const std::string& entry : split_list(list)) {
      if (has_wildcard(entry)) {
        for (const fs::path& file : find_wildcard(item.folder, entry)) {
          if (same(file.string(), item.path().string())) return true;
        }
      } else if (same(absolute_path(item.folder, entry).string(), item.path().string())) {
        return true;
      }
    }
    return false;
  }

  void remove(const std::string& type, const std::string& list) {
    std::erase_if(out_.items,
                  [&](const Item& item) { return same(item.type, type) && names(list, item); });
  }

  void update(const pugi::xml_node& node, const std::string& list) {
    for (Item& item : out_.items) {
      if (same(item.type, node.name()) && names(list, item)) set_metadata(node, item);
    }
  }

  Evaluation& out_;
  Notes& notes_;
  std::vector<std::unique_ptr<pugi::xml_document>> documents_;  // which groups point into
  std::vector<fs::path> open_;                                  // from the project to this import
  std::set<fs::path> imported_;
  std::vector<Later> definitions_;
  std::vector<Later> items_;
};

}  // namespace

std::string Evaluation::definition(const std::string& type, const std::string& name) const {
  const auto defaults = definitions.find(type);
  if (defaults == definitions.end()) return {};
  const auto found = defaults->second.find(name);
  return found == defaults->second.end() ? std::string() : found->second;
}

std::optional<Evaluation> evaluate(const fs::path& project, const NameMap& fixed, Notes& notes) {
  Evaluation out{Properties(project, fixed, notes), {}, {}};
  if (!Evaluator(out, notes).run()) return std::nullopt;
  return out;
}

}  // namespace kaamos::vcxproj
