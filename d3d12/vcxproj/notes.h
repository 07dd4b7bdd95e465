// SPDX-License-Identifier: MIT
//
// What an import has to say: errors, after which nothing is written, and what is left out or
// changed.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace kaamos::vcxproj {

enum class Topic {
  kConditions,  // that are taken for false
  kMissing,     // files and folders
  kShaders,
  kLibraries,
  kReferences,  // to other projects
  kCommands,
  kOptions,
  kItems,
};

class Notes {
 public:
  void error(const std::string& text);
  // Each text is kept once.
  void add(Topic topic, const std::string& text);

  const std::vector<std::string>& errors() const { return errors_; }
  const std::vector<std::string>& of(Topic topic) const;
  // Everything, a heading per topic and a line per note; "" without any.
  std::string text() const;

 private:
  std::vector<std::string> errors_;
  std::map<Topic, std::vector<std::string>> notes_;
};

}  // namespace kaamos::vcxproj
