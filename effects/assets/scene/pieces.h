// SPDX-License-Identifier: MIT
/// @file
/// Splits large meshes into pieces with a bottom level each, so that a room made of one mesh is not
/// a single box to every ray. [Northlight deck: Acceleration Structures, mesh piecing]
#pragma once

#include <cstddef>
#include <cstdint>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// Splits each mesh of more than `most_triangles` (at least 1) along the longest side of what its
/// triangles' centres span, in halves until the pieces are small enough; its instances become
/// instances of the pieces. Skinned meshes and levels of detail stay whole. The picture stays the
/// same but for instance and primitive numbers. Returns how many meshes were split.
std::size_t split_into_pieces(Scene& scene, std::uint32_t most_triangles);

}  // namespace kaamos::effects
