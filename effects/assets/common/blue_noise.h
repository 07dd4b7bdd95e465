// SPDX-License-Identifier: MIT
/// @file
/// Blue-noise tiles: neighbouring pixels get very different values, so that the error of few
/// samples appears as fine grain. The build makes them by void and cluster. [Ulichney 1993]
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace kaamos::effects {

/// Cells along each side of the tile that shaders read.
inline constexpr std::uint32_t kBlueNoiseSize = 128;

/// kBlueNoiseSize^2 pairs of independent tiles with values in (0, 1), row by row.
const std::vector<glm::vec2>& blue_noise_tile();

/// Returns the sample that a shader makes of the tile; value for value that of
/// effects/shaders/sampling.hlsli. Sample `index` of dimension pair `pair` in a pixel: the pixel's
/// tile value, shifted by the scrambled Sobol point on the torus. [GDC 2018 talk: noise tile plus
/// Sobol offset, wrapped]
glm::vec2 pixel_sample(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t pair,
                       std::uint32_t seed);

}  // namespace kaamos::effects
