// SPDX-License-Identifier: MIT
//
// Conditions of MSBuild: comparisons, And, Or, !, Exists, HasTrailingSlash, parentheses.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace kaamos::vcxproj {

// The value of a condition whose properties are expanded. Exists looks from `folder`. Nothing where
// it cannot be understood; "" is true.
std::optional<bool> evaluate_condition(std::string_view text, const std::filesystem::path& folder);

}  // namespace kaamos::vcxproj
