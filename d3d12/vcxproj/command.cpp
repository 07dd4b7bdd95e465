// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/command.h"

#include <algorithm>
#include <filesystem>

#include "d3d12/vcxproj/paths.h"
#include "d3d12/vcxproj/text.h"

namespace kaamos::vcxproj {
namespace {

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Of "copy /Y from to": from and to.
std::vector<std::string> copy_operands(const std::vector<std::string>& words) {
  std::vector<std::string> operands;
  for (size_t i = 1; i < words.size(); ++i) {
    // A path of this machine begins with a slash, too, but is longer than an option.
    const bool option = words[i].size() > 1 && words[i].front() == '/' &&
                        (words[i].size() <= 3 || words[i][2] == ':' || words[i][2] == '-') &&
                        words[i].find('/', 1) == std::string::npos;
    if (!option) operands.push_back(words[i]);
  }
  return operands;
}

Command parse_line(const std::string& line) {
  Command out;
  out.text = line;
  std::vector<std::string> words = split_words(line);
  if (words.empty()) {
    out.kind = Command::Kind::kNothing;
    return out;
  }
  if (words[0].starts_with('@')) words[0].erase(0, 1);
  std::string program = lower(std::filesystem::path(slashes(words[0])).filename().string());
  if (program.ends_with(".exe")) program.resize(program.size() - 4);
  if (is_one_of(program,
                {"", "rem", "echo", "md", "mkdir", "setlocal", "endlocal", "exit", "::"}) ||
      program.starts_with(':')) {
    out.kind = Command::Kind::kNothing;
  } else if (program == "dxc" || program == "fxc") {
    out.kind = Command::Kind::kDxc;
    out.arguments.assign(words.begin() + 1, words.end());
  } else if (is_one_of(program, {"copy", "xcopy"})) {
    out.arguments = copy_operands(words);
    if (out.arguments.size() == 2) out.kind = Command::Kind::kCopy;
  }
  return out;
}

}  // namespace

std::vector<std::string> split_words(std::string_view line) {
  std::vector<std::string> words;
  std::string word;
  bool quoted = false, open = false;
  const auto finish = [&] {
    if (open) words.push_back(word);
    word.clear();
    open = false;
  };
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
      open = true;
    } else if (!quoted && (c == ' ' || c == '\t' || c == '\r' || c == '\n')) {
      finish();
    } else {
      word += c;
      open = true;
    }
  }
  finish();
  // "> NUL", "2>&1": where a command prints to.
  std::vector<std::string> kept;
  for (size_t i = 0; i < words.size(); ++i) {
    const size_t arrow = words[i].find('>');
    if (arrow == std::string::npos || arrow > 1) {
      kept.push_back(words[i]);
    } else if (words[i].back() == '>') {
      ++i;
    }
  }
  return kept;
}

std::vector<Command> parse_commands(std::string_view text) {
  std::vector<Command> commands;
  for (const std::string& line : split_lines(text)) {
    // Parts joined by && are commands of their own.
    for (size_t begin = 0; begin <= line.size();) {
      const size_t end = std::min(line.find("&&", begin), line.size());
      const std::string part = trim(std::string_view(line).substr(begin, end - begin));
      if (!part.empty()) commands.push_back(parse_line(part));
      begin = end + 2;
    }
  }
  return commands;
}

}  // namespace kaamos::vcxproj
