// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/item_metadata.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "d3d12/vcxproj/evaluation.h"
#include "d3d12/vcxproj/paths.h"
#include "d3d12/vcxproj/text.h"

namespace kaamos::vcxproj {
namespace {

constexpr std::array<std::string_view, 8> kNames = {"Identity",  "FullPath",    "Filename",
                                                    "Extension", "RelativeDir", "Directory",
                                                    "RootDir",   "RecursiveDir"};

// Metadata may refer to metadata; this deep, it refers to itself.
constexpr int kDeepest = 16;

std::string value_of(const Item& item, const std::string& name, int depth) {
  if (is_well_known(name)) return well_known_value(item, name);
  const auto found = item.metadata.find(name);
  if (found == item.metadata.end() || depth > kDeepest) return {};
  return expand_metadata(
      found->second, [&](const std::string& inner) { return value_of(item, inner, depth + 1); });
}

}  // namespace

bool is_well_known(const std::string& name) {
  return std::any_of(kNames.begin(), kNames.end(),
                     [&](std::string_view each) { return same(each, name); });
}

std::string well_known_value(const Item& item, const std::string& name) {
  const std::string include = slashes(item.include);
  const std::filesystem::path path = item.path();
  if (same(name, "Identity")) return include;
  if (same(name, "FullPath")) return path.string();
  if (same(name, "Filename")) return path.stem().string();
  if (same(name, "Extension")) return path.extension().string();
  if (same(name, "RelativeDir")) {
    const size_t slash = include.rfind('/');
    return slash == std::string::npos ? "" : include.substr(0, slash + 1);
  }
  if (same(name, "Directory")) return path.parent_path().relative_path().string() + "/";
  if (same(name, "RootDir")) return "/";
  return {};  // RecursiveDir: wildcards are replaced by the files' names
}

std::filesystem::path Item::path() const {
  return absolute_path(folder, include);
}

std::string Item::value(const std::string& name) const {
  return value_of(*this, name, 0);
}

}  // namespace kaamos::vcxproj
