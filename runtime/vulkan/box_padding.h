// SPDX-License-Identifier: MIT
//
// Lavapipe tests boxes without room for rounding, so that some rays at shared edges slip through
// both neighbours (B4). This widens the boxes of a built tree in its memory, which is the driver's
// affair: it touches nothing that is not laid out as Mesa 25.0 does.
#pragma once

#include <cstdint>
#include <span>

namespace kaamos::vulkan {

// `structure`: memory of a structure with `leaves` primitives or instances. Each box grows by 1e-6
// of the largest coordinate on every side, unless that is more than 100 sizes of the whole. False,
// and nothing is changed, if any part of the tree is not as expected.
bool pad_boxes(std::span<uint8_t> structure, uint64_t leaves);

}  // namespace kaamos::vulkan
