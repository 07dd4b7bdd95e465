// SPDX-License-Identifier: MIT
/// @file
/// Reads and writes whole files.
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

/// Writes `bytes` as the whole contents of `path`, in a folder that exists. A regular file is
/// replaced in one step and keeps its permissions, a link its target: an interrupted or failed run
/// leaves earlier output untouched. Devices and pipes are written to.
/// @errors KA3000 no permission, a full disk, a folder that is missing.
Status write_file(const std::string& path, std::span<const std::uint8_t> bytes);

/// The same with the bytes of a text.
/// @errors as of write_file.
Status write_text(const std::string& path, const std::string& text);

/// Makes the finished file `from` the contents of `path`, as write_file would; `from` is gone then.
/// @errors as of write_file; `from` is left where it is.
Status place_file(const std::string& from, const std::string& path);

}  // namespace kaamos::effects
