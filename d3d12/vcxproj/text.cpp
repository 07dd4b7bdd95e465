// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/text.h"

#include <algorithm>
#include <cctype>

namespace kaamos::vcxproj {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> out;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(separator, begin), text.size());
    std::string entry = trim(text.substr(begin, end - begin));
    if (!entry.empty()) out.push_back(std::move(entry));
    begin = end + 1;
  }
  return out;
}

}  // namespace

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string trim(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(kSpace) - begin + 1));
}

bool same(std::string_view a, std::string_view b) {
  return lower(a) == lower(b);
}

bool starts_with_any_case(std::string_view text, std::string_view start) {
  return same(text.substr(0, start.size()), start);
}

std::vector<std::string> split_list(std::string_view text) {
  return split(text, ';');
}
std::vector<std::string> split_lines(std::string_view text) {
  return split(text, '\n');
}

void add_once(std::vector<std::string>& list, const std::string& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

}  // namespace kaamos::vcxproj
