// SPDX-License-Identifier: MIT
//
// Lavapipe tests boxes without room for rounding, so that some rays at shared edges slip between
// both neighbours (B4). This widens the boxes of a built tree in place. That memory is the driver's
// own, so nothing is touched unless it is laid out exactly as in Mesa 25.0.
#pragma once

#include <cstdint>
#include <span>

namespace kaamos::vulkan {

// `structure` is the memory of a structure with `leaves` primitives or instances. Each box grows by
// 1e-6 of the largest coordinate on every side, unless that coordinate is more than 100 times the
// size of the whole. Returns false and changes nothing if any part of the tree is not as expected.
bool pad_boxes(std::span<uint8_t> structure, uint64_t leaves);

}  // namespace kaamos::vulkan
