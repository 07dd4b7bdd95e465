// SPDX-License-Identifier: MIT
/// @file
/// Node transforms as glTF allows them. Only gltf_*.cpp include it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace kaamos::effects {

/// `transform` as a product of matrices, outermost first, each of which is a scale, then a
/// rotation, then an offset: one where it has no shear, else two. glTF allows a node no other
/// matrix. [glTF 2.0: Transformations]
std::vector<glm::dmat4> without_shear(const glm::dmat4& transform);

}  // namespace kaamos::effects
