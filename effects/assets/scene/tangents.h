// SPDX-License-Identifier: MIT
/// @file
/// Computes normals and tangents for vertices that lack them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "effects/assets/scene/mesh.h"

namespace kaamos::effects {

/// Gives every triangle its own three vertices with the triangle's normal, as glTF wants where a
/// file has no normals. `indices` becomes 0, 1, 2, ...
void make_flat_normals(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices);

/// Area-weighted mean of the adjacent triangles' normals. Vertices are one where they share an
/// index; those without area get +Y.
void make_smooth_normals(std::span<Vertex> vertices, std::span<const std::uint32_t> indices);

/// Tangents along +u, perpendicular to the normal, with the handedness of the uv mapping. Where uv
/// is degenerate any perpendicular vector is taken. Vertices of both handednesses should not be
/// shared; where they are, the larger side wins.
void make_tangents(std::span<Vertex> vertices, std::span<const std::uint32_t> indices);

/// A unit vector perpendicular to the unit vector `n`, without branches or weak spots.
/// [Duff et al. 2017, Building an Orthonormal Basis, Revisited]
glm::vec3 any_perpendicular(const glm::vec3& n);

}  // namespace kaamos::effects
