// SPDX-License-Identifier: MIT
/// @file
/// Counts per pixel as colours: black, blue, red, yellow, white.
#pragma once

#include <cstdint>
#include <span>

#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// Writes the colour of a heat from 0 (black) to 1 (white) into 3 bytes.
void put_heat(float heat, std::uint8_t* out);

/// A picture of counts, and what its colors stand for.
struct HeatMap {
  ByteImage image;          ///< 3 channels
  std::uint32_t white = 1;  ///< count that is white: 999 of 1000 pixels have no more
  std::uint32_t most = 0;   ///< the largest count
  double mean = 0;          ///< over all pixels
};

/// `counts`: width * height, row 0 on top; missing ones are 0.
HeatMap heat_map(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> counts);

}  // namespace kaamos::effects
