// SPDX-License-Identifier: MIT
//
// The properties of a project, $(Name), and the references to metadata, %(Name).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "d3d12/vcxproj/notes.h"
#include "d3d12/vcxproj/text.h"

namespace kaamos::vcxproj {

class Properties {
 public:
  // For `project`, an absolute path. `fixed` are properties that it cannot change, as those of
  // MSBuild's command line.
  Properties(const std::filesystem::path& project, const NameMap& fixed, Notes& notes);

  void set(const std::string& name, const std::string& value);
  // "" where there is none.
  std::string get(const std::string& name) const;

  // Replaces each $(Name). Unknown ones become nothing. So do calls, $([...]) and $(Name.Call()),
  // which are noted, but for GetDirectoryNameOfFileAbove and GetPathOfFileAbove.
  std::string expand(std::string_view text) const;

  // MSBuildThisFile...: those of the file that is read now.
  void set_file(const std::filesystem::path& file);

  const std::filesystem::path& project() const { return project_; }
  std::filesystem::path folder() const { return project_.parent_path(); }

 private:
  std::filesystem::path project_;
  NameMap values_;
  NameMap fixed_;
  Notes* notes_;
};

// The value of a metadata's name; without one the reference stays as it is.
using MetadataLookup = std::function<std::optional<std::string>(const std::string& name)>;

// Replaces each %(Name) and %(Type.Name).
std::string expand_metadata(std::string_view text, const MetadataLookup& lookup);

}  // namespace kaamos::vcxproj
