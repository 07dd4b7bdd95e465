// SPDX-License-Identifier: MIT
//
// Paths of projects, which are Windows', as this machine's.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaamos::vcxproj {

// With slashes for backslashes, and without quotation marks.
std::string slashes(std::string_view path);

// `path`, relative to `folder` unless it is absolute, in normal form and without a slash at the
// end.
std::filesystem::path absolute_path(const std::filesystem::path& folder, std::string_view path);

// The file or folder that `path` names in any letter case.
std::optional<std::filesystem::path> find_path(const std::filesystem::path& folder,
                                               std::string_view path);

bool has_wildcard(std::string_view path);

// The files that a path with *, ? and ** names, in order of their names. What stands before the
// first wildcard is found in any letter case, and so are the names.
std::vector<std::filesystem::path> find_wildcard(const std::filesystem::path& folder,
                                                 std::string_view path);

// `path` below `folder`, "." for the folder itself; nothing where it is elsewhere. Letter case is
// ignored.
std::optional<std::string> path_below(const std::filesystem::path& folder,
                                      const std::filesystem::path& path);

}  // namespace kaamos::vcxproj
