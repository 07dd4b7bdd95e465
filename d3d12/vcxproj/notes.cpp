// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/notes.h"

#include "d3d12/vcxproj/text.h"

namespace kaamos::vcxproj {
namespace {

const char* heading(Topic topic) {
  switch (topic) {
    case Topic::kConditions:
      return "conditions that are not understood and taken for false";
    case Topic::kMissing:
      return "not found, left out";
    case Topic::kShaders:
      return "shaders";
    case Topic::kLibraries:
      return "libraries that Kaamos does not have, left out";
    case Topic::kReferences:
      return "references to projects";
    case Topic::kCommands:
      return "commands, left out";
    case Topic::kOptions:
      return "options";
    case Topic::kItems:
      return "items and elements, left out";
  }
  return "";
}

}  // namespace

void Notes::error(const std::string& text) {
  add_once(errors_, text);
}

void Notes::add(Topic topic, const std::string& text) {
  add_once(notes_[topic], text);
}

const std::vector<std::string>& Notes::of(Topic topic) const {
  static const std::vector<std::string> kNone;
  const auto found = notes_.find(topic);
  return found == notes_.end() ? kNone : found->second;
}

std::string Notes::text() const {
  std::string out;
  for (const auto& [topic, notes] : notes_) {
    out += std::string(heading(topic)) + ":\n";
    for (const std::string& note : notes) out += "  " + note + "\n";
  }
  return out;
}

}  // namespace kaamos::vcxproj
