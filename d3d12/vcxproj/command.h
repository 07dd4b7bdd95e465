// SPDX-License-Identifier: MIT
//
// Commands of custom builds and build events: copies and calls of dxc and fxc are known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kaamos::vcxproj {

struct Command {
  enum class Kind { kCopy, kDxc, kNothing, kOther };

  Kind kind = Kind::kOther;
  std::string text;                    // the line
  std::vector<std::string> arguments;  // without the program; of copies the source and the target
};

// A command's words, as cmd.exe and the C library split them. Redirections are left out.
std::vector<std::string> split_words(std::string_view line);

// The commands of a text of several lines. kNothing are those that need no counterpart: making
// folders, printing, changing error levels.
std::vector<Command> parse_commands(std::string_view text);

}  // namespace kaamos::vcxproj
