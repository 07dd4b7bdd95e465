// SPDX-License-Identifier: MIT
//
// A geometry shader that passes triangles on and gives their corners the barycentrics (1, 0, 0),
// (0, 1, 0) and (0, 0, 1), for drivers whose pixel shaders have none. [BARY] It also gives every
// corner what GetAttributeAtVertex reads of the second and third.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/backend/linked_graphics.h"

namespace kaamos::vulkan {

// Its SPIR-V, for the outputs of the vertex shader. Specialization constant 0: how many slices the
// targets have.
std::vector<uint32_t> barycentrics_code(const runtime::LinkedGraphics& linked);

}  // namespace kaamos::vulkan
