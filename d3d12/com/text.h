// SPDX-License-Identifier: MIT
// Wide strings: wchar_t holds a code point here.
#pragma once

#include <string>
#include <string_view>

namespace kaamos::d3d12 {

/// UTF-8 of a wide string; empty for null. What is no code point becomes U+FFFD.
std::string to_utf8(const wchar_t* text);
std::string to_utf8(std::wstring_view text);
/// The code points of UTF-8. What is no UTF-8 becomes U+FFFD.
std::wstring to_wide(std::string_view text);

/// A path of this system: programs write slashes or backslashes.
///@{
std::string to_path(std::string path);
std::string to_path(const wchar_t* path);
///@}

}  // namespace kaamos::d3d12
