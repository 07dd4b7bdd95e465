// SPDX-License-Identifier: MIT
/// @file
/// Reads and writes whole files. A file that is replaced keeps its old content until the new one is
/// complete on disk, so an interrupted or failed run leaves earlier output untouched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"

namespace kaamos::effects {

/// Reads a whole file into memory.
/// @errors KA3000 a file that is missing, unreadable, no regular file, or larger than `max_bytes`.
Result<std::vector<std::uint8_t>> read_file(const std::string& path,
                                            std::size_t max_bytes = std::size_t{4} << 30);

/// Writes `bytes` to a temporary file beside `path` and renames it over `path`. The folder must
/// exist. On any error the temporary file is removed and a previous `path` is left as it was.
/// @errors KA3000 no permission, a full disk, a folder that is missing.
Status write_file_atomically(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace kaamos::effects
