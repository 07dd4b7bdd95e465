// SPDX-License-Identifier: MIT
/// @file
/// Finds where a picture of depths has edges: errors of what was traced at fewer pixels are there.
#pragma once

#include <cstdint>
#include <vector>

#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// Returns for each pixel whether it has an edge of the depth within `reach` pixels to the side,
/// above or below. `view_z`: one channel, metres along the camera's axis, 0 where nothing is. An
/// edge is between two pixels in a row or column whose depths do not go on where the pixels before
/// or after them lead: a slanted surface has none.
std::vector<bool> edge_band(const FloatImage& view_z, std::uint32_t reach);

}  // namespace kaamos::effects
