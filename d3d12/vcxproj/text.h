// SPDX-License-Identifier: MIT
//
// Text as MSBuild takes it: names without regard to letter case, lists that semicolons part.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kaamos::vcxproj {

std::string lower(std::string_view text);
std::string trim(std::string_view text);
bool same(std::string_view a, std::string_view b);
bool starts_with_any_case(std::string_view text, std::string_view start);

// The entries of "a; b;;c", without spaces around them and without empty ones.
std::vector<std::string> split_list(std::string_view text);
std::vector<std::string> split_lines(std::string_view text);

// Appends `value` unless `list` has it.
void add_once(std::vector<std::string>& list, const std::string& value);

struct LessAnyCase {
  bool operator()(const std::string& a, const std::string& b) const { return lower(a) < lower(b); }
};
using NameMap = std::map<std::string, std::string, LessAnyCase>;

}  // namespace kaamos::vcxproj
