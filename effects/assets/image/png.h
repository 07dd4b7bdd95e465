// SPDX-License-Identifier: MIT
/// @file
/// PNG files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// The bytes of a PNG file, 8 bits per channel.
/// @errors KA3001 a side of 0 or above 65,535, channels other than 1, 3 or 4, values of another
/// size than width * height * channels.
Result<std::vector<std::uint8_t>> encode_png(const ByteImage& image);

/// Writes a PNG file; an earlier one at `path` stays as it was on any error.
/// @errors those of encode_png and write_file.
Status write_png(const std::string& path, const ByteImage& image);

/// Reads a PNG of any kind as 4 channels of 8 bits.
/// @errors KA3000 as of read_file; KA3001 a file that is no PNG, damaged, or too large for memory.
Result<ByteImage> read_png(const std::string& path);

}  // namespace kaamos::effects
