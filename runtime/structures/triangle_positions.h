// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: the vertices of a bottom level's triangles as shaders read them on the CPU. [DXR:
// TriangleObjectPositions]
#pragma once

#include <vector>

#include "kaamos/shader/triangle_positions.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

// One for each geometry. They point into the level, which must outlive them, and stay valid while
// it is updated in place.
std::vector<shader::GeometryPositions> positions_of(const BottomLevelBase& level, BuildFlags flags);

}  // namespace kaamos::runtime
