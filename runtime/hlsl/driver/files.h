// SPDX-License-Identifier: MIT
//
// Contents of files, and names for them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace kaamos::hlsl {

// The bytes of a file; none if it cannot be read.
std::string read_file(const std::filesystem::path& path);

// 128 bits as 32 hexadecimal digits.
std::string content_hash(std::string_view bytes);

}  // namespace kaamos::hlsl
