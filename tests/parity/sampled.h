// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kaamos::parity {

// `count` values along the line from a texel of 0 to one of 1, with 8 bits each: value i should be
// (i + 0.5) / count. Throws rtapi::ResultError.
std::vector<float> sample_between_texels(const std::string& backend, uint32_t count);

}  // namespace kaamos::parity
