// SPDX-License-Identifier: MIT
/// @file
/// Compares two renderers' pictures of a scene within what their noise allows.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"

namespace kaamos {

/// Two independent pictures of one renderer, which tell its noise.
using TwoHalves = std::array<effects::FloatImage, 2>;

/// The difference between two renderers.
struct RendererDifference {
  std::uint64_t pixels = 0;      ///< compared
  double mean = 0.0;             ///< of the second renderer, over pixels and channels
  double bias = 0.0;             ///< mean of first - second
  double bias_error = 0.0;       ///< its standard error
  double rms = 0.0;              ///< root mean square of first - second, per pixel and channel
  double expected_rms = 0.0;     ///< what the noise of both makes of it
  double worst_tile = 0.0;       ///< |bias| of a tile over its allowance; above 1: too much
  std::uint32_t tile_x = 0;      ///< pixel in the middle of that tile
  std::uint32_t tile_y = 0;      ///< see tile_x
  double tile_difference = 0.0;  ///< of that tile, over its mean
};

/// The difference that is allowed for tiles, and for the whole.
struct Allowance {
  std::uint32_t tile = 10;  ///< pixels of a tile's side
  double errors = 5.0;      ///< standard errors of the mean
  double relative = 2e-3;   ///< and so much of the mean itself
};

/// Pixels that show one flat face with all of their neighbours: 1, else 0. `ids` and `normal`:
/// layers of northlight's frame.exr.
/// @errors KA3004 different sizes.
effects::Result<effects::FloatImage> smooth_pixels(const effects::FloatImage& ids,
                                                   const effects::FloatImage& normal);

/// Compares the first three channels of all pictures where `smooth` is not 0.
/// @errors KA3004 different sizes; a value that is not finite; no smooth pixel.
effects::Result<RendererDifference> compare_renderers(const TwoHalves& first,
                                                      const TwoHalves& second,
                                                      const effects::FloatImage& smooth,
                                                      const Allowance& allowance);

/// True where neither a tile nor the whole differs by more than its noise and the allowance.
bool agrees(const RendererDifference& difference, const Allowance& allowance);

/// One line of a table.
std::string describe(const RendererDifference& difference);

}  // namespace kaamos
