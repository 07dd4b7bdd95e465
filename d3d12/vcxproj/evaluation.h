// SPDX-License-Identifier: MIT
//
// A project file with all that it imports, evaluated as MSBuild does: properties, then defaults of
// items, then items.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "d3d12/vcxproj/notes.h"
#include "d3d12/vcxproj/properties.h"
#include "d3d12/vcxproj/text.h"

namespace kaamos::vcxproj {

struct Item {
  std::string type;              // such as ClCompile
  std::string include;           // as the project writes it, macros replaced
  std::filesystem::path folder;  // which `include` is relative to
  NameMap metadata;              // with the defaults

  // The file itself; it need not exist.
  std::filesystem::path path() const;
  // Metadata's value, with %(Filename), %(FullPath) and the like replaced; "" without any.
  std::string value(const std::string& name) const;
  bool is(const std::string& name) const { return same(trim(value(name)), "true"); }
};

struct Evaluation {
  Properties properties;
  std::vector<Item> items;
  // Defaults of a type of items, such as Link and PostBuildEvent.
  std::map<std::string, NameMap, LessAnyCase> definitions;

  // A default's value, "" without any.
  std::string definition(const std::string& type, const std::string& name) const;
};

// Reads `project`, an absolute path, with `fixed` properties (Configuration, Platform and what the
// user sets). Without a value `notes` has errors.
std::optional<Evaluation> evaluate(const std::filesystem::path& project, const NameMap& fixed,
                                   Notes& notes);

}  // namespace kaamos::vcxproj
